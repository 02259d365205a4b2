#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::client {

/// A cellcrushd on a Unix socket of its own that serves only this process: the one beside this program, or else the one
/// in $PATH. It ends with this process at the latest; a running job is then left at a checkpoint in the data folder.
class PrivateDaemon {
 public:
  /// Waits until it serves. `time_limit_s` limits its jobs; 0: no limit. Its log is `data`/daemon.log. Throws
  /// CommandError (refused) with the last log line if it does not start.
  PrivateDaemon(const std::filesystem::path& data, double time_limit_s);

  /// The same on a temporary data folder, with the ended jobs of these results, which it reads where they are: jobs/1
  /// and so on, in their order. `results`: files, or folders with a result.h5. Throws CommandError (refused) that says
  /// which cannot be read, and why. Without results it has no jobs.
  explicit PrivateDaemon(const std::vector<std::string>& results);

  ~PrivateDaemon();
  PrivateDaemon(const PrivateDaemon&) = delete;
  PrivateDaemon& operator=(const PrivateDaemon&) = delete;

  [[nodiscard]] std::string address() const { return "unix:" + socket().string(); }

  /// Whether it has ended unexpectedly.
  [[nodiscard]] bool has_ended();

  [[nodiscard]] const std::filesystem::path& log() const { return log_; }

  /// Stops it and waits for its end. Throws CommandError (refused) if it does not end within a minute.
  void stop();

 private:
  [[nodiscard]] std::filesystem::path socket() const { return folder_ / "socket"; }
  // Both throw CommandError (refused), and then leave no folder.
  void serve(const std::filesystem::path& data, double time_limit_s);
  void import(const std::filesystem::path& data, const std::vector<std::string>& results);
  void remove_folder();

  std::filesystem::path log_;
  std::filesystem::path folder_;  ///< of the socket; a socket path has at most 107 bytes
  pid_t pid_ = -1;
};

}  // namespace cellcrush::client
