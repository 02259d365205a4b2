#include "jobs/worker_follower.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

#include "store/durable_file.h"
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

const std::filesystem::path& existing(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0600);
  if (file < 0) store::throw_file_error(path, "written", errno);
  close(file);
  return path;
}

}  // namespace

WorkerFollower::WorkerFollower(const store::JobFolder& folder, const WorkerEvents& events,
                               const Interruptions& interruptions, std::chrono::milliseconds stall_limit)
    : events_(events), interruptions_(interruptions), stall_limit_(stall_limit), reader_(existing(folder.reports())) {
  // Otherwise a request is seen at the next reading.
  requested_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
}

WorkerFollower::~WorkerFollower() {
  if (requested_ >= 0) close(requested_);
}

bool WorkerFollower::catch_up() { return read_reports(false) != Reading::broken; }

// A worker that has ended makes no progress.
WorkerFollower::Reading WorkerFollower::read_reports(bool live) {
  Reading out = Reading::nothing_new;
  while (true) {
    switch (reader_.read(report_)) {
      case worker::ReportLogReader::Read::end: return out;
      case worker::ReportLogReader::Read::broken: return Reading::broken;
      case worker::ReportLogReader::Read::message: break;
    }
    out = Reading::something_new;
    if (report_.has_begun()) final_.reset();
    if (report_.has_final()) {
      final_ = report_.final();
    } else if (report_.has_stopping()) {
      acknowledged_ = live;
    } else if (live || !report_.has_progress()) {
      if (report_.has_progress()) progress_ = report_.progress();
      events_.reported(report_);
    }
  }
}

WorkerExit WorkerFollower::follow(WorkerProcess& process) {
  final_.reset();
  last_sign_ = Clock::now();
  const auto wake = [this] { eventfd_write(requested_, 1); };
  const std::stop_callback on_stop(interruptions_.stop, wake);
  const std::stop_callback on_suspend(interruptions_.suspend, wake);
  const std::stop_callback on_cancel(interruptions_.cancel, wake);
  while (true) {
    // Checked before reading the reports, so that everything written before the end is read.
    const bool ended = process.has_ended();
    const Reading reading = read_reports(true);
    if (reading == Reading::broken) return exit_of(process, WorkerExit::Kind::broken);
    if (ended) return exit_of(process, WorkerExit::Kind::exited);
    if (final_) {
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
      acknowledged_ = false;
    } else if (acknowledged_) {
      limit_ = now + kToCloseTheResult;
      acknowledged_ = false;
    }
  } else if (!told_to_leave_ && (interruptions_.stop.stop_requested() || interruptions_.suspend.stop_requested())) {
    process.send(worker::kSuspendSignal);
    limit_ = now + kToLeaveTheJob;
    told_to_leave_ = true;
  }
}

// Processor time is checked rarely: a worker reports five times a second.
bool WorkerFollower::is_stalled(const WorkerProcess& process, Reading reading) {
  const auto now = Clock::now();
  if (reading == Reading::something_new) last_sign_ = now;
  if (now - last_sign_ < stall_limit_ / 2) return false;
  const auto times = worker::times_of(process.number());
  if (times && times->used != used_) {
    used_ = times->used;
    last_sign_ = now;
    return false;
  }
  if (!progress_.stalled()) report_stall();
  return now - last_sign_ > stall_limit_;
}

void WorkerFollower::report_stall() {
  progress_.set_stalled(true);
  worker::Report report;
  *report.mutable_progress() = progress_;
  events_.reported(report);
}

WorkerExit WorkerFollower::exit_of(WorkerProcess& process, WorkerExit::Kind ended_for) const {
  using Kind = WorkerExit::Kind;
  const auto status = process.end();
  WorkerExit out;
  out.final = final_;
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
