#include "jobs/worker_follower.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

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

}  // namespace

WorkerFollower::WorkerFollower(const store::JobFolder& folder, const WorkerEvents& events,
                               const Interruptions& interruptions, std::chrono::milliseconds stall_limit)
    : events_(events), interruptions_(interruptions), stall_limit_(stall_limit), feed_(folder, events) {
  // Otherwise a request is seen at the next reading.
  requested_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
}

WorkerFollower::~WorkerFollower() {
  if (requested_ >= 0) close(requested_);
}

bool WorkerFollower::catch_up() { return feed_.read(false) != ReportFeed::Reading::broken; }

WorkerExit WorkerFollower::follow(WorkerProcess& process) {
  feed_.forget_last_word();
  last_sign_ = Clock::now();
  const auto wake = [this] { eventfd_write(requested_, 1); };
  const std::stop_callback on_stop(interruptions_.stop, wake);
  const std::stop_callback on_suspend(interruptions_.suspend, wake);
  const std::stop_callback on_cancel(interruptions_.cancel, wake);
  while (true) {
    // Checked before reading the reports, so that everything written before the end is read.
    const bool ended = process.has_ended();
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

void WorkerFollower::wait(const WorkerProcess& process) const {
  std::array<pollfd, 2> waiting = {pollfd{process.descriptor(), POLLIN, 0}, pollfd{requested_, POLLIN, 0}};
  const auto interval = events_.watched() ? kLookForWatchers : kLookAgain;
  const auto since_last_moment = Clock::now().time_since_epoch() % interval;
  const auto to_next_moment = std::chrono::ceil<std::chrono::milliseconds>(interval - since_last_moment);
  poll(waiting.data(), waiting.size(), static_cast<int>(to_next_moment.count()));
  eventfd_t none = 0;
  if (waiting[1].revents != 0) eventfd_read(requested_, &none);
}

void WorkerFollower::forward_requests(const WorkerProcess& process) {
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
bool WorkerFollower::is_stalled(const WorkerProcess& process, ReportFeed::Reading reading) {
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

WorkerExit WorkerFollower::exit_of(WorkerProcess& process, WorkerExit::Kind ended_for) const {
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

}  // namespace cellcrush::jobs
