#pragma once

#include <chrono>
#include <filesystem>

#include "slurm/kept_daemon.h"

namespace cellcrush::testing {

inline constexpr const char* kMariadbd = "/usr/sbin/mariadbd";
inline constexpr const char* kSlurmdbd = "/usr/sbin/slurmdbd";
/// The tables that MariaDB itself needs; slurmdbd creates its own.
inline constexpr const char* kMariadbTables = "/usr/share/mysql/mysql_system_tables.sql";

/// The accounting of a SlurmCluster: slurmdbd on a port of loopback, and a MariaDB server without a port. The server
/// asks for no password, as only the calling user can reach its socket. Not thread-safe.
class SlurmAccounting {
 public:
  /// `folder` is the cluster's, with slurm.conf in it; all files and logs lie below it. Only reserves the port.
  SlurmAccounting(std::filesystem::path folder, std::filesystem::path munge_socket);
  ~SlurmAccounting();
  SlurmAccounting(const SlurmAccounting&) = delete;
  SlurmAccounting& operator=(const SlurmAccounting&) = delete;

  /// Of slurmdbd.
  [[nodiscard]] int port() const { return port_.number(); }

  /// Starts both. slurmdbd answers about 1 s after the return. False when the database has no socket within `limit`.
  /// REQUIRES: munged runs, slurm.conf is written.
  [[nodiscard]] bool start(std::chrono::milliseconds limit);

 private:
  // Returns the path of its socket.
  std::filesystem::path start_database();

  std::filesystem::path folder_;
  std::filesystem::path munge_socket_;
  ReservedPort port_;
  KeptDaemon database_;
  KeptDaemon slurmdbd_;
};

}  // namespace cellcrush::testing
