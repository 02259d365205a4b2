#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>

#include "jobs/executor.h"
#include "slurm/attempt.pb.h"
#include "slurm/attempt_folder.h"
#include "slurm/mirror.h"
#include "store/job_folder.h"

namespace cellcrush::slurm {

/// Why a task ends, for whatever it computes at the moment; REASON_UNSPECIFIED: it goes on.
using TaskEnd = std::atomic<Ended::Reason>;

/// One attempt on a node: a worker in a folder of its own, and beside it the copying of its files to the attempt's.
class AttemptRun {
 public:
  /// `lease`: without contact for so long, the worker leaves the job at a checkpoint. All outlive it.
  AttemptRun(const AttemptFolder& shared, jobs::Executor& workers, const TaskEnd& end, std::chrono::milliseconds lease)
      : shared_(shared), workers_(workers), end_(end), lease_(lease) {}

  /// Computes the claimed attempt in this folder of the node, which has its order. Returns once the daemon has the last
  /// word, or the attempt is no longer this task's.
  void run(const store::JobFolder& folder);

 private:
  using Clock = std::chrono::steady_clock;

  /// Copies, renews the lease and obeys requests until the worker has ended.
  void accompany(const std::stop_token& worker_ended);
  /// Makes the worker leave once the lease is over, also while a call to the shared file system does not return.
  void watch_lease(const std::stop_token& worker_ended);
  bool keep_contact();
  void obey(Request::Kind request);
  Ended last_word_of(const jobs::WorkerExit& exit) const;
  /// Tries until it succeeds or the attempt is no longer this task's.
  void hand_over(const Ended& ended);

  const AttemptFolder& shared_;
  jobs::Executor& workers_;
  const TaskEnd& end_;
  std::chrono::milliseconds lease_;
  std::optional<Mirror> mirror_;
  std::stop_source leave_;
  std::stop_source suspend_;
  std::stop_source cancel_;
  std::uint64_t beats_ = 0;
  std::atomic<Clock::time_point> last_contact_ = Clock::now();
  Clock::time_point last_beat_{};
  std::atomic<bool> is_lease_lost_ = false;
  bool is_abandoned_ = false;
  std::int64_t first_step_ = 0;
};

}  // namespace cellcrush::slurm
