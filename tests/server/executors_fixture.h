#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/small_case.h"
#include "server/small_cluster.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {

inline constexpr const char* kCluster = "slurm/test";

/// A daemon with a second executor, which each test chooses.
class ExecutorsTest : public DaemonFixture {
 protected:
  void SetUp() override {}

  // The cluster outlives the daemon.
  void TearDown() override { daemon_.reset(); }

  [[nodiscard]] DaemonOptions with_cluster(int slots = 2) {
    auto options = default_options();
    options.executors.push_back(cluster_.executor(kCluster, slots));
    options.hold_times = {std::chrono::milliseconds(20), std::chrono::milliseconds(200)};
    return options;
  }

  // A second executor of workers on this machine, from that program.
  [[nodiscard]] DaemonOptions with_program(const std::filesystem::path& program) const {
    auto options = default_options();
    options.hold_times = {std::chrono::milliseconds(20), std::chrono::milliseconds(200)};
    options.executors.push_back({kCluster, 2, [program](const jobs::ExecutorSurroundings& given) {
                                   return std::make_unique<jobs::LocalProcess>(program, given.stall_limit);
                                 }});
    return options;
  }

  void restart(const DaemonOptions& options) {
    daemon_.reset();
    start(options);
  }

  static v1::CreateJobRequest job_on(const std::string& executor, const v1::Case& submitted = tiny_case()) {
    auto out = job_of(submitted);
    out.set_executor(executor);
    return out;
  }

  static std::string create_on(Client& client, const std::string& executor, const v1::Case& submitted = tiny_case()) {
    return client.create(job_on(executor, submitted)).name();
  }

  static v1::Sweep create_sweep_on(Client& client, const std::string& executor, const v1::Case& submitted) {
    auto request = sweep_of(submitted, "plates.friction", {0.0, 0.1, 0.2});
    request.mutable_sweep()->set_executor(executor);
    return create(client, request);
  }

  bool wait_for_place(Client& client, const std::string& job) {
    return wait_until([&] { return !client.get(job).place().empty(); });
  }

  SmallCluster cluster_;
};

}  // namespace cellcrush::testing
