#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/sweeps_service.pb.h"
#include "server/daemon_fixture.h"

namespace cellcrush::testing {

inline constexpr const char* kSpeed = "loading.speed_m_per_s";

/// A sweep of a case over one field.
v1::CreateSweepRequest sweep_of(const v1::Case& submitted, const std::string& field, const std::vector<double>& values);

/// Makes the sweep; fails the test when it is refused.
v1::Sweep create(Client& client, const v1::CreateSweepRequest& request);

/// The sweep as it is now.
v1::Sweep get_sweep(Client& client, const std::string& name);

/// These fail the test when they are refused.
v1::Sweep cancel_sweep(Client& client, const std::string& name);
v1::Sweep retry(Client& client, const std::string& name);
v1::SweepTable table_of(Client& client, const std::string& name);

/// How many of its jobs are in that state.
int count_in(const v1::Sweep& sweep, v1::Job::State state);

/// Waits until that many of its jobs are in that state, at most 60 s.
bool wait_for_count(Client& client, const std::string& name, v1::Job::State state, int count);

/// What a watch gave, and how it ended.
struct WatchedSweep {
  std::vector<v1::WatchSweepResponse> responses;
  grpc::Status status;
};

/// Watches to the end, or until that many responses with a token were read.
WatchedSweep watch_sweep(Client& client, const std::string& name, const std::string& token = "", int tokens = -1);

}  // namespace cellcrush::testing
