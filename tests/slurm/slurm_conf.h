#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::testing {

/// What a test may want otherwise than SlurmCluster has it.
struct SlurmOptions {
  int kill_wait_s = 2;            ///< between SIGTERM and SIGKILL
  std::string preempt_mode = {};  ///< REQUEUE, CANCEL or SUSPEND,GANG; empty: there is no partition `low`
  bool accounting = false;        ///< whether sacct works, up to 5 s late. REQUIRES: slurm_accounting_is_installed()
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
