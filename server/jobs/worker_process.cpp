#include "jobs/worker_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <iterator>
#include <system_error>
#include <utility>

#include "worker/claim.h"

// glibc 2.36 declares these without C linkage.
extern "C" {
#include <sys/pidfd.h>
}

namespace cellcrush::jobs {

int start_process(std::vector<std::string> command, const std::vector<int>& blocked, const std::vector<int>& streams,
                  pid_t& process) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int as = 0; as < std::ssize(streams); ++as) {
    const int inherited = streams[static_cast<std::size_t>(as)];
    const int access = as == STDOUT_FILENO || as == STDERR_FILENO ? O_WRONLY : O_RDONLY;
    inherited < 0 ? posix_spawn_file_actions_addopen(&actions, as, "/dev/null", access, 0)
                  : posix_spawn_file_actions_adddup2(&actions, inherited, as);
  }
  posix_spawn_file_actions_addclosefrom_np(&actions, static_cast<int>(streams.size()));
  sigset_t mask;
  sigset_t all;
  sigemptyset(&mask);
  for (const int signal : blocked) sigaddset(&mask, signal);
  sigfillset(&all);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigmask(&attributes, &mask);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (auto& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error = posix_spawnp(&process, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

WorkerProcess::WorkerProcess(pid_t process, bool is_child)
    : process_(process), is_child_(is_child), descriptor_(pidfd_open(process, 0)) {
  if (descriptor_ || errno == ESRCH) return;
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
  if (!out.descriptor_ || !times || times->start != claimed->start_time) return std::nullopt;
  return out;
}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept
    : process_(std::exchange(other.process_, 0)),
      is_child_(std::exchange(other.is_child_, false)),
      descriptor_(std::move(other.descriptor_)) {}

WorkerProcess::~WorkerProcess() {
  if (is_child_) end();
}

void WorkerProcess::send(int signal) const { pidfd_send_signal(descriptor_.get(), signal, nullptr, 0); }

bool WorkerProcess::ends_within(std::chrono::milliseconds limit) const {
  pollfd waiting{descriptor_.get(), POLLIN, 0};
  return poll(&waiting, 1, static_cast<int>(limit.count())) > 0;
}

std::optional<int> WorkerProcess::end() {
  send(SIGKILL);
  if (!is_child_) {
    pollfd waiting{descriptor_.get(), POLLIN, 0};
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
