#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace cellcrush::client {

/// A cellcrushd that serves this process alone on a Unix socket of its own. It ends with this process
/// at the latest; a job that runs is then left at a checkpoint in the data folder.
class PrivateDaemon {
 public:
  /// Starts the cellcrushd that lies beside this program, else that of $PATH, and waits until it serves. Its jobs may
  /// take `time_limit_s`; 0: no limit. Its log is `data`/daemon.log. Throws CommandError (refused) with the last line
  /// of the log when it does not.
  PrivateDaemon(const std::filesystem::path& data, double time_limit_s);
  ~PrivateDaemon();
  PrivateDaemon(const PrivateDaemon&) = delete;
  PrivateDaemon& operator=(const PrivateDaemon&) = delete;

  [[nodiscard]] std::string address() const { return "unix:" + socket().string(); }

  /// Whether it has ended without being asked to.
  [[nodiscard]] bool has_ended();

  [[nodiscard]] const std::filesystem::path& log() const { return log_; }

  /// Ends it in order and waits for that. Throws CommandError (refused) when it does not end within a minute.
  void stop();

 private:
  [[nodiscard]] std::filesystem::path socket() const { return folder_ / "socket"; }

  std::filesystem::path log_;
  std::filesystem::path folder_;  ///< of the socket, whose path may be 107 bytes long at most
  pid_t pid_ = -1;
};

}  // namespace cellcrush::client
