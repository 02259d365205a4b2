#pragma once

#include <sys/types.h>

namespace cellcrush::jobs {

/// A started process; ended and waited for at the latest when this goes out of scope. Only its owner's thread waits for
/// it; `kill_now` may come from another thread while the owner does not wait.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Sends SIGKILL and does not wait.
  void kill_now() const;

  /// Ends it at once. Returns its wait status.
  int end();

  /// Gives it some seconds to end by itself, for it has closed its socket. Returns its wait status.
  int let_end();

 private:
  int wait(int flags);

  pid_t pid_;
  bool reaped_ = false;
};

}  // namespace cellcrush::jobs
