#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/daemon_fixture.h"

namespace cellcrush::testing {

/// All numbers of a job's result that are no times of a clock.
struct JobNumbers {
  std::vector<std::string> history;
  std::vector<std::string> frames;
  std::string summary;

  bool operator==(const JobNumbers&) const = default;
};

/// Of a job that has a result.
JobNumbers numbers_of(Client& client, const std::filesystem::path& data_folder, const std::string& job);

/// Watches the job behind a number to the end, and fails the test where the contract of watches is broken. The watch's
/// end, and the number of the last event in `last`.
grpc::Status watch_soundly(Client& client, const std::string& job, std::int64_t after = 0,
                           std::int64_t* last = nullptr);

/// Watches the job to its end, which must be a success.
void expect_success(Client& client, const std::string& job);

/// Makes a job and waits until it has so many samples.
std::string create_with_samples(Client& client, const v1::Case& submitted, std::size_t count);

/// Waits until the job has so many samples, at most 12 s.
void wait_for_samples(Client& client, const std::string& job, std::size_t count);

}  // namespace cellcrush::testing
