#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>

#include "store/job_folder.h"

namespace cellcrush::jobs {

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
  [[nodiscard]] int descriptor() const { return descriptor_; }

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
  int descriptor_;
};

}  // namespace cellcrush::jobs
