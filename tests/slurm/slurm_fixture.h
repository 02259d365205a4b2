#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "programs/temporary_folder.h"
#include "server/small_case.h"
#include "slurm/executor_run.h"
#include "slurm/slurm_cluster.h"
#include "slurm/slurm_executor.h"

namespace cellcrush::testing {

/// An executor on a real cluster, and folders of jobs. The test is skipped where Slurm is not installed.
class SlurmFixture : public ::testing::Test {
 protected:
  void SetUp() override;

  void start_cluster(const SlurmOptions& options = {});

  /// With short times, so that tests are quick.
  [[nodiscard]] slurm::ClusterOptions quick_options() const;

  /// Instead of the one before, as when a daemon ends and the next one starts.
  void start_executor(const slurm::ClusterOptions& options);
  void start_executor() { start_executor(quick_options()); }

  /// Exists on return.
  [[nodiscard]] store::JobFolder job_folder(int number = 1) const;

  /// Runs the job from where it was left.
  [[nodiscard]] std::unique_ptr<ExecutorRun> run(const v1::Case& submitted, int number = 1);

  /// A run without an end, whose task is killed once it has begun.
  [[nodiscard]] std::unique_ptr<ExecutorRun> run_and_kill_task();

  /// The samples of the case as this machine computes them without a cluster.
  std::vector<std::string> local_samples(const v1::Case& submitted);

  /// Number of attempts whose folders are there.
  [[nodiscard]] std::size_t attempt_count() const;

  /// Puts a script in the place of a command of Slurm, with $REAL for the real one. Returns the folder of commands.
  std::filesystem::path replace_command(const std::string& name, const std::string& script);

  /// A program for the nodes that writes into one log what each task begins and ends.
  [[nodiscard]] std::filesystem::path logging_program() const;
  /// Number of lines in that log with these words.
  /// Waits until there are so many: a task writes its last lines as it ends.
  [[nodiscard]] int count_in_log(const std::string& words, int expected = 0) const;

  TemporaryFolder folder_;
  std::unique_ptr<SlurmCluster> cluster_;
  std::unique_ptr<slurm::SlurmExecutor> executor_;
};

/// A crush that takes about ten seconds.
v1::Case slow_case();

/// Without the samples that a resumed run repeats: each as it was first reported.
std::vector<std::string> without_repeats(const std::vector<std::string>& samples);

}  // namespace cellcrush::testing
