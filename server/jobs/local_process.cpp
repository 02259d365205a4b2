#include "jobs/local_process.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "jobs/worker_follower.h"
#include "jobs/worker_process.h"
#include "store/durable_file.h"
#include "worker/worker_main.h"

namespace cellcrush::jobs {
namespace {

// The value of "oom_kill" in a file with one name and number per line.
std::optional<std::uint64_t> read_count(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string name;
  for (std::uint64_t count = 0; file >> name >> count;) {
    if (name == "oom_kill") return count;
  }
  return std::nullopt;
}

// For version 2 control groups the line is "0::/path".
std::filesystem::path control_group() {
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("0::")) return "/sys/fs/cgroup" + line.substr(3);
  }
  return {};
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

std::uint64_t count_oom_kills() {
  const auto group = control_group();
  if (const auto count = group.empty() ? std::nullopt : read_count(group / "memory.events")) return *count;
  return read_count("/proc/vmstat").value_or(0);
}

bool LocalProcess::has_worker(const store::JobFolder& folder) { return WorkerProcess::find(folder).has_value(); }

std::optional<WorkerExit> LocalProcess::read_final_report(const store::JobFolder& folder, const WorkerEvents& events) {
  const Interruptions none;
  WorkerFollower follower(folder, events, none, stall_limit_);
  if (!follower.catch_up()) return WorkerExit{.kind = WorkerExit::Kind::broken};
  if (!follower.last_word() || follower.last_word()->has_suspended_step()) return std::nullopt;
  return WorkerExit{.kind = WorkerExit::Kind::gone, .final = follower.last_word()};
}

void LocalProcess::end_worker(const store::JobFolder& folder) {
  if (auto process = WorkerProcess::find(folder)) process->end();
}

WorkerExit LocalProcess::run(const store::JobFolder& folder, const worker::Order& order, const WorkerEvents& events,
                             const Interruptions& interruptions) {
  auto process = WorkerProcess::find(folder);
  WorkerFollower follower(folder, events, interruptions, stall_limit_);
  if (!follower.catch_up()) {
    if (process) process->end();
    return {.kind = WorkerExit::Kind::broken};
  }
  if (process) return follow(*process, follower, events, oom_kills_);
  write_order(folder, order);
  pid_t child = 0;
  std::vector<std::string> command = {program_.string(), "worker", "--folder", folder.root().string()};
  if (life_ == Life::ends_with_parent) command.insert(command.end(), {"--end-with", std::to_string(getpid())});
  // It may outlive the daemon, so it inherits no descriptor.
  const int error = start_process(command, {worker::kSuspendSignal, worker::kCancelSignal}, -1, -1, child);
  if (error != 0) return {.kind = WorkerExit::Kind::not_started, .code = error};
  process.emplace(WorkerProcess::of_child(child));
  WorkerExit out = follow(*process, follower, events, oom_kills_);
  if (out.kind != WorkerExit::Kind::exited || out.code != worker::kFolderIsClaimed) return out;
  // A worker that an earlier daemon had just started claimed the folder first.
  auto faster = WorkerProcess::find(folder);
  return faster ? follow(*faster, follower, events, oom_kills_) : out;
}

}  // namespace cellcrush::jobs
