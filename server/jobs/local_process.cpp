#include "jobs/local_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <string>

#include "jobs/worker_follower.h"
#include "jobs/worker_process.h"
#include "store/durable_file.h"
#include "worker/worker_main.h"

namespace cellcrush::jobs {
namespace {

// Starts a worker in the folder. It may outlive the daemon, so it inherits no descriptors but the standard three, which
// are opened on /dev/null. Returns 0 or an errno.
int spawn(const std::filesystem::path& program, const store::JobFolder& folder, LocalProcess::Life life, pid_t& pid) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigset_t all;
  sigemptyset(&signals);
  sigaddset(&signals, worker::kSuspendSignal);
  sigaddset(&signals, worker::kCancelSignal);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &signals);
  posix_spawnattr_setsigdefault(&attributes, &all);
  // A separate process group, so that Ctrl-C at the daemon's terminal reaches the daemon only.
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);

  std::string name = program.string();
  std::string command = "worker";
  std::string option = "--folder";
  std::string place = folder.root().string();
  std::string ends = "--end-with";
  std::string own = std::to_string(getpid());
  std::array<char*, 7> arguments = {name.data(), command.data(), option.data(), place.data(),
                                    nullptr,     nullptr,        nullptr};
  if (life == LocalProcess::Life::ends_with_parent) {
    arguments[4] = ends.data();
    arguments[5] = own.data();
  }
  const int error = posix_spawn(&pid, name.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

WorkerExit not_started(int error) {
  WorkerExit out;
  out.kind = WorkerExit::Kind::not_started;
  out.code = error;
  return out;
}

void write_order(const store::JobFolder& folder, const worker::Order& order) {
  errno = 0;
  std::ofstream file(folder.order(), std::ios::binary | std::ios::trunc);
  if (file) order.SerializeToOstream(&file);
  file.flush();
  if (!file) store::throw_file_error(folder.order(), "written", errno);
}

WorkerExit follow(WorkerProcess& process, WorkerFollower& follower, const WorkerEvents& events,
                  const OomKills& oom_kills) {
  try {
    const std::uint64_t before = oom_kills();
    events.started(process.number());
    WorkerExit out = follower.follow(process);
    const bool was_killed = out.kind == WorkerExit::Kind::signalled && out.code == SIGKILL;
    out.out_of_memory = (was_killed || out.kind == WorkerExit::Kind::gone) && oom_kills() > before;
    return out;
  } catch (...) {
    process.end();
    throw;
  }
}

}  // namespace

bool LocalProcess::has_worker(const store::JobFolder& folder) { return WorkerProcess::find(folder).has_value(); }

std::optional<WorkerExit> LocalProcess::read_final_report(const store::JobFolder& folder, const WorkerEvents& events) {
  const Interruptions none;
  WorkerFollower follower(folder, events, none, stall_limit_);
  WorkerExit out;
  out.kind = WorkerExit::Kind::broken;
  if (!follower.catch_up()) return out;
  if (!follower.last_word() || follower.last_word()->has_suspended_step()) return std::nullopt;
  out.kind = WorkerExit::Kind::gone;
  out.final = follower.last_word();
  return out;
}

void LocalProcess::end_worker(const store::JobFolder& folder) {
  if (auto process = WorkerProcess::find(folder)) process->end();
}

WorkerExit LocalProcess::run(const store::JobFolder& folder, const worker::Order& order, const WorkerEvents& events,
                             const Interruptions& interruptions) {
  auto process = WorkerProcess::find(folder);
  WorkerFollower follower(folder, events, interruptions, stall_limit_);
  WorkerExit out;
  if (!follower.catch_up()) {
    if (process) process->end();
    out.kind = WorkerExit::Kind::broken;
    return out;
  }
  if (process) return follow(*process, follower, events, oom_kills_);
  write_order(folder, order);
  pid_t child = 0;
  if (const int error = spawn(program_, folder, life_, child); error != 0) return not_started(error);
  process.emplace(WorkerProcess::of_child(child));
  out = follow(*process, follower, events, oom_kills_);
  if (out.kind != WorkerExit::Kind::exited || out.code != worker::kFolderIsClaimed) return out;
  // A worker that an earlier daemon had just started claimed the folder first.
  auto faster = WorkerProcess::find(folder);
  return faster ? follow(*faster, follower, events, oom_kills_) : out;
}

}  // namespace cellcrush::jobs
