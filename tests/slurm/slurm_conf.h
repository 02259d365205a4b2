#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::testing {

/// What a test may want otherwise than SlurmCluster has it. Times are short, so that tests are quick.
struct SlurmOptions {
  int cpus_per_node = 1;          ///< may be more than the machine has
  int min_job_age_s = 300;        ///< how long squeue -t all lists a job that has ended; then up to 10 s more
  int kill_wait_s = 2;            ///< between SIGTERM and SIGKILL
  int slurmd_timeout_s = 3;       ///< a node that is silent for so long goes down; it takes about 10 s in all
  int message_timeout_s = 2;      ///< for an answer of a daemon; also for connecting to one that is gone
  int requeue_delay_s = 5;        ///< how long a requeued job waits at least; Slurm takes no less than 5
  int max_array_size = 10001;     ///< one above the largest index of an array
  std::string preempt_mode = {};  ///< REQUEUE, CANCEL or SUSPEND,GANG; empty: there is no partition `low`
  int grace_time_s = 0;           ///< how long a preempted job of `low` runs on; SIGTERM reaches its script at the end
  bool accounting = false;        ///< whether sacct works, up to 5 s late. REQUIRES: slurm_accounting_is_installed()
  std::vector<std::string> lines = {};  ///< added to slurm.conf
};

/// Ports of loopback for the daemons.
struct SlurmPorts {
  int controller = 0;
  std::vector<int> nodes;
  int accounting = 0;  ///< of slurmdbd; 0: there is none
};

/// Text of a slurm.conf for a controller and one node a port, all on this machine and run by the calling user. The
/// nodes are n1, n2 and so on. All files lie below `folder`, munge's socket at `munge_socket`.
std::string slurm_conf_text(const SlurmOptions& options, const SlurmPorts& ports, const std::filesystem::path& folder,
                            const std::filesystem::path& munge_socket);

/// Text of the slurmdbd.conf that belongs to it. slurmdbd takes the database's socket from its environment.
std::string slurmdbd_conf_text(int port, const std::filesystem::path& folder,
                               const std::filesystem::path& munge_socket);

/// Of the calling user, or the number if there is no name.
std::string user_name();

}  // namespace cellcrush::testing
