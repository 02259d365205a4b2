#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "open_file.h"
#include "store/job_folder.h"

namespace cellcrush::jobs {

/// Starts a program, found by PATH unless its name has a slash. Its group is its own, so that Ctrl-C at the daemon's
/// terminal reaches the daemon only. Its descriptors are `streams`, that is input, output, errors and others, -1:
/// /dev/null. Only the signals of `blocked` are blocked, and none is handled. Returns 0 or an errno.
int start_process(std::vector<std::string> command, const std::vector<int>& blocked, const std::vector<int>& streams,
                  pid_t& process);

/// A worker process: a child of this process, or one started by an earlier daemon. The destructor kills and reaps a
/// child; other processes keep running. Not thread-safe. Construction throws std::system_error if no descriptor is
/// available; a child is then killed.
class WorkerProcess {
 public:
  /// REQUIRES: this process started `child` and has not reaped it.
  static WorkerProcess of_child(pid_t child) { return {child, true}; }

  /// The process that runs in the folder.
  static std::optional<WorkerProcess> find(const store::JobFolder& folder);

  ~WorkerProcess();
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) = delete;

  [[nodiscard]] pid_t number() const { return process_; }
  /// Becomes readable when the process ends.
  [[nodiscard]] int descriptor() const { return descriptor_.get(); }

  void send(int signal) const;
  [[nodiscard]] bool has_ended() const { return ends_within(std::chrono::milliseconds(0)); }
  [[nodiscard]] bool ends_within(std::chrono::milliseconds limit) const;

  /// Kills it if it still runs, and reaps it. Returns its wait status; nothing if it is not a child.
  std::optional<int> end();

 private:
  WorkerProcess(pid_t process, bool is_child);
  int wait_for_child();

  pid_t process_;
  bool is_child_;
  OpenFile descriptor_;
};

}  // namespace cellcrush::jobs
