#include "jobs/child.h"

#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

namespace cellcrush::jobs {

Child::~Child() {
  if (!reaped_) end();
}

void Child::kill_now() const { kill(pid_, SIGKILL); }

int Child::end() {
  kill_now();
  return wait(0);
}

int Child::let_end() {
  for (int i = 0; i < 500; ++i) {
    const int status = wait(WNOHANG);
    if (reaped_) return status;
    std::this_thread::sleep_for(std::chrono::milliseconds(i < 50 ? 1 : 10));
  }
  return end();
}

int Child::wait(int flags) {
  int status = 0;
  pid_t waited = -1;
  do {
    waited = waitpid(pid_, &status, flags);
  } while (waited < 0 && errno == EINTR);
  reaped_ = waited != 0;
  return status;
}

}  // namespace cellcrush::jobs
