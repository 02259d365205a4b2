#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "programs/process.h"
#include "programs/temporary_folder.h"
#include "slurm/slurm_conf.h"

namespace cellcrush::testing {

/// A daemon_keeper with the daemon below it; both end with the object, and with the thread that made it.
using KeptDaemon = std::unique_ptr<e2e::Process>;

/// A free port of 127.0.0.1 that only a daemon of this test is given. Daemons that set SO_REUSEADDR can bind to it, as
/// this object does not listen.
class ReservedPort {
 public:
  /// Throws std::runtime_error when no port is free.
  ReservedPort();
  ~ReservedPort();
  ReservedPort(const ReservedPort&) = delete;
  ReservedPort& operator=(const ReservedPort&) = delete;

  [[nodiscard]] int number() const { return number_; }

 private:
  int socket_ = -1;
  int number_ = 0;
};

/// Whether the programs of Slurm and munge that a SlurmCluster needs are here. A test without them is skipped:
///   if (!slurm_is_installed()) GTEST_SKIP() << kSlurmIsMissing;
bool slurm_is_installed();
inline constexpr const char* kSlurmIsMissing = "Slurm is not installed; run deploy/install-packages slurm";

/// Whether a SlurmCluster with SlurmOptions::accounting can start here.
bool slurm_accounting_is_installed();
inline constexpr const char* kSlurmAccountingIsMissing =
    "slurmdbd or MariaDB is not installed; run deploy/install-packages slurm";

/// A Slurm cluster of two nodes on this machine: munged, slurmctld and two slurmd, all of the calling user, in a
/// temporary folder and on ports of loopback that are its own, so that several clusters run side by side. No service of
/// the system is touched. Everything below the daemons is killed with the object, and also when the thread that made it
/// or the test's process dies; whatever jobs have started is part of that. Not thread-safe.
///
/// Partition `main` has both nodes, and is the default. With SlurmOptions::preempt_mode there is a second one, `low`,
/// whose jobs give way to those of `main`.
class SlurmCluster {
 public:
  /// Nodes are counted from 1.
  static constexpr int kNodes = 2;

  /// What kill_node does to the processes of the node's jobs.
  enum class JobProcesses {
    die,      ///< as when the machine loses its power
    survive,  ///< they run on, and Slurm has lost them
  };

  /// Returns when both nodes are idle, after about 2 s, or 3 s with accounting. Throws std::runtime_error with the
  /// daemons' logs when they are not within 60 s. REQUIRES: slurm_is_installed().
  explicit SlurmCluster(const SlurmOptions& options = {});
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  /// Path of slurm.conf, for SLURM_CONF.
  [[nodiscard]] const std::filesystem::path& config() const { return config_; }
  /// For scripts and outputs of jobs; both nodes see it. It goes away with the cluster.
  [[nodiscard]] std::filesystem::path shared_folder() const { return folder_.path() / "shared"; }

  /// Runs a command of Slurm, such as {"sbatch", "job.sh"}, in this cluster. It is killed when its time is up, and the
  /// outcome's `timed_out` is set.
  [[nodiscard]] e2e::Outcome run(const std::vector<std::string>& command,
                                 std::chrono::milliseconds limit = std::chrono::seconds(10)) const;

  /// Runs the command again and again until it succeeds with this output, but for blanks at its end. False when the
  /// time was up before.
  [[nodiscard]] bool wait_for(const std::vector<std::string>& command, const std::string& output,
                              std::chrono::milliseconds limit) const;

  /// The exit codes of a job's tasks, in ascending order, once all have ended; empty when they do not in this time.
  /// Quicker than `sbatch --wait`, which looks every ten seconds.
  [[nodiscard]] std::vector<int> wait_for_exit_codes(const std::string& job, std::chrono::milliseconds limit) const;

  /// SIGKILL for slurmd and its slurmstepd. Slurm sees it after about 10 s; the state is then `down*`.
  void kill_node(int node, JobProcesses processes = JobProcesses::die);

  /// SIGTERM for slurmctld, which saves its state; waits for its end. Nodes and jobs run on.
  void stop_controller();
  /// REQUIRES: the controller was stopped. Returns when it answers.
  void start_controller();

  /// What the daemons have logged.
  [[nodiscard]] std::string logs() const;

 private:
  int reserve_port();
  void start_node(int node);
  /// As `sinfo` says it, such as `idle`, `allocated`, `down*`; the asterisk is for a node that does not answer.
  [[nodiscard]] std::string node_state(int node) const;
  KeptDaemon start(const std::string& name, const std::vector<std::string>& command) const;
  void start_munge();
  void start_accounting(int port, const std::filesystem::path& munge_socket);

  TemporaryFolder folder_;
  std::filesystem::path config_;
  std::vector<std::unique_ptr<ReservedPort>> reserved_ports_;
  KeptDaemon munge_;
  KeptDaemon database_;
  KeptDaemon slurmdbd_;
  KeptDaemon controller_;
  std::vector<KeptDaemon> nodes_;
  std::vector<KeptDaemon> lost_;  // of killed nodes whose jobs survive
};

}  // namespace cellcrush::testing
