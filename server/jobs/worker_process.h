#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>

#include "store/job_folder.h"

namespace cellcrush::jobs {

/// A worker process: a child of this one, or one that an earlier daemon started. A child is ended and waited for at the
/// latest when this goes away; another one goes on. Not thread-safe. To make one throws std::system_error where there
/// is no descriptor for it; a child is then ended.
class WorkerProcess {
 public:
  /// REQUIRES: `child` was started by this process and not waited for.
  static WorkerProcess of_child(pid_t child) { return {child, true}; }

  /// The one that runs in the folder.
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

  /// Ends it if it has not, and waits. Its wait status; nothing when it is no child.
  std::optional<int> end();

 private:
  WorkerProcess(pid_t process, bool is_child);
  int wait_for_child();

  pid_t process_;
  bool is_child_;
  int descriptor_;
};

}  // namespace cellcrush::jobs
