#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "jobs/executor.h"
#include "jobs/report_feed.h"
#include "jobs/worker_process.h"

namespace cellcrush::jobs {

/// Follows the reports of one job's workers, from the first report on, and forwards requests to the running worker. Not
/// thread-safe. Failures throw ServiceError.
class WorkerFollower {
 public:
  WorkerFollower(const store::JobFolder& folder, const WorkerEvents& events, const Interruptions& interruptions,
                 std::chrono::milliseconds stall_limit);
  ~WorkerFollower();
  WorkerFollower(const WorkerFollower&) = delete;
  WorkerFollower& operator=(const WorkerFollower&) = delete;

  /// Delivers the reports of earlier workers. Returns the final report, if the last worker made one. False if a report
  /// is malformed.
  bool catch_up();
  [[nodiscard]] const std::optional<worker::Final>& last_word() const { return feed_.last_word(); }

  /// Follows a worker until it has ended.
  WorkerExit follow(WorkerProcess& process);

 private:
  using Clock = std::chrono::steady_clock;

  void wait(const WorkerProcess& process) const;
  void forward_requests(const WorkerProcess& process);
  bool is_stalled(const WorkerProcess& process, ReportFeed::Reading reading);
  WorkerExit exit_of(WorkerProcess& process, WorkerExit::Kind ended_for) const;

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
};

}  // namespace cellcrush::jobs
