#include "jobs/worker_process.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include "worker/claim.h"

// glibc 2.36 declares these without C linkage.
extern "C" {
#include <sys/pidfd.h>
}

namespace cellcrush::jobs {

WorkerProcess::WorkerProcess(pid_t process, bool is_child)
    : process_(process), is_child_(is_child), descriptor_(pidfd_open(process, 0)) {
  if (descriptor_ >= 0 || errno == ESRCH) return;
  const int error = errno;
  // Without a way to follow it, the child must not keep running.
  if (is_child_) {
    kill(process_, SIGKILL);
    wait_for_child();
  }
  throw std::system_error(error, std::generic_category(), "The worker process cannot be monitored");
}

std::optional<WorkerProcess> WorkerProcess::find(const store::JobFolder& folder) {
  const auto claimed = worker::find_claim(folder);
  if (!claimed) return std::nullopt;
  WorkerProcess out(claimed->process, false);
  // Before the descriptor was opened the id may have been reused, but not after.
  const auto times = worker::times_of(claimed->process);
  if (out.descriptor_ < 0 || !times || times->start != claimed->start_time) return std::nullopt;
  return out;
}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept
    : process_(std::exchange(other.process_, 0)),
      is_child_(std::exchange(other.is_child_, false)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

WorkerProcess::~WorkerProcess() {
  if (is_child_) end();
  if (descriptor_ >= 0) close(descriptor_);
}

void WorkerProcess::send(int signal) const { pidfd_send_signal(descriptor_, signal, nullptr, 0); }

bool WorkerProcess::ends_within(std::chrono::milliseconds limit) const {
  pollfd waiting{descriptor_, POLLIN, 0};
  return poll(&waiting, 1, static_cast<int>(limit.count())) > 0;
}

std::optional<int> WorkerProcess::end() {
  send(SIGKILL);
  if (!is_child_) {
    pollfd waiting{descriptor_, POLLIN, 0};
    while (poll(&waiting, 1, -1) < 0 && errno == EINTR) continue;
    return std::nullopt;
  }
  return wait_for_child();
}

int WorkerProcess::wait_for_child() {
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  is_child_ = false;
  return status;
}

}  // namespace cellcrush::jobs
