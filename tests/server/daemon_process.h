#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "programs/process.h"

namespace cellcrush::testing {

/// cellcrushd as a process of its own; killed at the latest when this goes away, or the thread that made it, as in a
/// test that is aborted. Workers outlive it all the same.
class DaemonProcess {
 public:
  /// The daemon of this build; another one if the environment names it (CELLCRUSHD_PROGRAM), to compare the two.
  /// Without HTTP, unless the arguments name its port. Under a hard limit on file descriptors; 0: that of this process.
  explicit DaemonProcess(const std::vector<std::string>& arguments, int most_descriptors = 0);

  /// Reads until that many addresses were printed or the process ended, at most 30 s. Returns the addresses.
  std::vector<std::string> wait_for_addresses(std::size_t count);

  [[nodiscard]] pid_t number() const { return process_->id(); }
  void send_signal(int number) const { process_->send(number); }
  /// Waits for the end, at most 20 s, then kills. Returns the exit code, or -1 - signal when a signal ended it.
  int wait();
  /// Memory that is resident; 0 when it has ended.
  [[nodiscard]] std::size_t resident_bytes() const;
  /// Reads stderr until the words have come, at most 20 s; whether they have.
  [[nodiscard]] bool wait_for_error(const std::string& words);
  /// What it has written to stderr; REQUIRES: wait was called.
  [[nodiscard]] const std::string& errors() const { return process_->errors(); }

 private:
  std::unique_ptr<e2e::Process> process_;
};

/// Whether the process is there and not a zombie.
bool is_alive(pid_t process);

/// Whether the thread of this process sleeps: it waits for a lock, a condition or a call of the kernel.
bool is_asleep(pid_t thread);

/// Kills the workers that a daemon which was killed has left behind.
void kill_workers(const std::filesystem::path& data_folder);

/// Waits until it is not, at most that long; whether it went.
bool wait_until_gone(pid_t process, std::chrono::milliseconds limit);

}  // namespace cellcrush::testing
