#include "jobs/local_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "allotment.h"
#include "jobs/outcome.h"
#include "jobs/report_feed.h"
#include "jobs/worker_process.h"
#include "store/durable_file.h"
#include "store/lattice_file.h"
#include "worker/claim.h"
#include "worker/worker_main.h"

namespace cellcrush::jobs {
namespace {

constexpr std::chrono::seconds kToAcknowledge{2};
constexpr std::chrono::seconds kToCloseTheResult{25};
constexpr std::chrono::seconds kToLeaveTheJob{20};
constexpr std::chrono::seconds kToEndAfterTheLastWord{5};
// Interval between readings of the reports, for a watched job and for others. A worker reports a few hundred times a
// second. Reports in between are read together, and all jobs are read at the same moments.
constexpr std::chrono::milliseconds kLookForWatchers{50};
constexpr std::chrono::milliseconds kLookAgain{200};

/// Follows the reports of one job's workers, from the first report on, and forwards requests to the running worker. Not
/// thread-safe. Failures throw ServiceError.
class WorkerFollower {
 public:
  WorkerFollower(const store::JobFolder& folder, const WorkerEvents& events, const Interruptions& interruptions,
                 std::chrono::milliseconds stall_limit)
      : events_(events), interruptions_(interruptions), stall_limit_(stall_limit), feed_(folder, events) {
    // Otherwise a request is seen at the next reading.
    requested_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  }
  ~WorkerFollower() {
    if (requested_ >= 0) close(requested_);
  }
  WorkerFollower(const WorkerFollower&) = delete;
  WorkerFollower& operator=(const WorkerFollower&) = delete;

  /// The most memory that the worker was seen to have, bytes.
  [[nodiscard]] std::int64_t most_memory() const { return most_memory_; }

  /// Delivers the reports of earlier workers. Returns the final report, if the last worker made one. False if a report
  /// is malformed.
  bool catch_up() { return feed_.read(false) != ReportFeed::Reading::broken; }
  [[nodiscard]] const std::optional<worker::Final>& last_word() const { return feed_.last_word(); }

  /// Follows a worker until it has ended.
  WorkerExit follow(WorkerProcess& process) {
    feed_.forget_last_word();
    last_sign_ = Clock::now();
    const auto wake = [this] { eventfd_write(requested_, 1); };
    const std::stop_callback on_stop(interruptions_.stop, wake);
    const std::stop_callback on_suspend(interruptions_.suspend, wake);
    const std::stop_callback on_cancel(interruptions_.cancel, wake);
    while (true) {
      // Checked before reading the reports, so that everything written before the end is read.
      const bool ended = process.has_ended();
      if (!ended) most_memory_ = std::max(most_memory_, worker::peak_memory_of(process.number()));
      const auto reading = feed_.read(true);
      if (reading == ReportFeed::Reading::broken) return exit_of(process, WorkerExit::Kind::broken);
      if (ended) return exit_of(process, WorkerExit::Kind::exited);
      if (feed_.last_word()) {
        (void)process.ends_within(kToEndAfterTheLastWord);
        return exit_of(process, WorkerExit::Kind::exited);
      }
      forward_requests(process);
      if (limit_ && Clock::now() > *limit_) return exit_of(process, WorkerExit::Kind::exited);
      if (is_stalled(process, reading)) return exit_of(process, WorkerExit::Kind::stalled);
      wait(process);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  void wait(const WorkerProcess& process) const {
    std::array<pollfd, 2> waiting = {pollfd{process.descriptor(), POLLIN, 0}, pollfd{requested_, POLLIN, 0}};
    const auto interval = events_.watched() ? kLookForWatchers : kLookAgain;
    const auto since_last_moment = Clock::now().time_since_epoch() % interval;
    const auto to_next_moment = std::chrono::ceil<std::chrono::milliseconds>(interval - since_last_moment);
    poll(waiting.data(), waiting.size(), static_cast<int>(to_next_moment.count()));
    eventfd_t none = 0;
    if (waiting[1].revents != 0) eventfd_read(requested_, &none);
  }

  void forward_requests(const WorkerProcess& process) {
    const auto now = Clock::now();
    if (interruptions_.cancel.stop_requested()) {
      if (!told_to_end_) {
        process.send(worker::kCancelSignal);
        limit_ = now + kToAcknowledge;
        told_to_end_ = true;
        static_cast<void>(feed_.take_acknowledgement());
      } else if (feed_.take_acknowledgement()) {
        limit_ = now + kToCloseTheResult;
      }
    } else if (!told_to_leave_ && (interruptions_.stop.stop_requested() || interruptions_.suspend.stop_requested())) {
      process.send(worker::kSuspendSignal);
      limit_ = now + kToLeaveTheJob;
      told_to_leave_ = true;
    }
  }

  // Processor time is checked rarely: a worker reports five times a second.
  bool is_stalled(const WorkerProcess& process, ReportFeed::Reading reading) {
    const auto now = Clock::now();
    if (reading == ReportFeed::Reading::something_new) last_sign_ = now;
    if (now - last_sign_ < stall_limit_ / 2) return false;
    const auto times = worker::times_of(process.number());
    if (times && times->used != used_) {
      used_ = times->used;
      last_sign_ = now;
      return false;
    }
    feed_.report_stall();
    return now - last_sign_ > stall_limit_;
  }

  WorkerExit exit_of(WorkerProcess& process, WorkerExit::Kind ended_for) const {
    using Kind = WorkerExit::Kind;
    const auto status = process.end();
    WorkerExit out;
    out.final = feed_.last_word();
    out.kind = ended_for;
    if (ended_for == Kind::exited) {
      if (!status)
        out.kind = Kind::gone;
      else if (WIFSIGNALED(*status))
        out.kind = Kind::signalled;
    }
    if (status) out.code = WIFSIGNALED(*status) ? WTERMSIG(*status) : WEXITSTATUS(*status);
    if (interruptions_.cancel.stop_requested()) {
      out.kind = Kind::cancelled;
    } else if (told_to_leave_) {
      out.kind = interruptions_.suspend.stop_requested() ? Kind::suspended : Kind::stopped;
    }
    return out;
  }

  const WorkerEvents& events_;
  const Interruptions& interruptions_;
  std::chrono::milliseconds stall_limit_;
  int requested_ = -1;  ///< eventfd, readable once there is a request
  ReportFeed feed_;
  std::optional<Clock::time_point> limit_;  ///< when to kill a worker that has received a request
  bool told_to_leave_ = false;
  bool told_to_end_ = false;
  Clock::time_point last_sign_;  ///< of life
  std::uint64_t used_ = 0;       ///< processor time at last_sign_, in the kernel's ticks
  std::int64_t most_memory_ = 0;
};

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
  OpenFile file = store::open_own(folder.order(), O_WRONLY | O_CREAT | O_TRUNC);
  store::write_all(file, folder.order(), order.SerializeAsString());
  if (!file.close()) store::throw_file_error(folder.order(), "written", errno);
}

WorkerExit follow(WorkerProcess& process, WorkerFollower& follower, const WorkerEvents& events,
                  const OomKills& oom_kills) {
  try {
    const std::uint64_t before = oom_kills();
    events.started(process.number());
    WorkerExit out = follower.follow(process);
    const bool was_killed = out.kind == WorkerExit::Kind::signalled && out.code == SIGKILL;
    out.out_of_memory = (was_killed || out.kind == WorkerExit::Kind::gone) && oom_kills() > before;
    if (out.out_of_memory) {
      constexpr std::int64_t kOneMebibyte = 1024 * 1024;
      out.detail = fmt::format(
          "The kernel killed the worker process, which used {} MiB: its machine or control group, with {} MiB, ran out "
          "of memory.",
          follower.most_memory() / kOneMebibyte, usable_memory() / kOneMebibyte);
    }
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
  if (!follower.last_word() || follower.last_word()->has_suspended_step() || needs_more_memory(*follower.last_word()))
    return std::nullopt;
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
  worker::Order own = store::put_lattice_apart(folder, order);
  own.set_device(device_);
  write_order(folder, own);
  pid_t child = 0;
  std::vector<std::string> command = {program_.string(), "worker", "--folder", folder.root().string()};
  if (life_ == Life::ends_with_parent) command.insert(command.end(), {"--end-with", std::to_string(getpid())});
  // It may outlive the daemon, so it inherits no descriptor.
  const int error = start_process(command, {worker::kSuspendSignal, worker::kCancelSignal}, {-1, -1, -1}, child);
  if (error != 0) return {.kind = WorkerExit::Kind::not_started, .code = error};
  process.emplace(WorkerProcess::of_child(child));
  WorkerExit out = follow(*process, follower, events, oom_kills_);
  if (out.kind != WorkerExit::Kind::exited || out.code != worker::kFolderIsClaimed) return out;
  // A worker that an earlier daemon had just started claimed the folder first.
  auto faster = WorkerProcess::find(folder);
  return faster ? follow(*faster, follower, events, oom_kills_) : out;
}

}  // namespace cellcrush::jobs
