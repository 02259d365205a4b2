#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "jobs/job_runner.h"
#include "jobs/queue_hold.h"
#include "jobs/waiting_jobs.h"
#include "metrics/metrics.h"
#include "mutex.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"

namespace cellcrush::jobs {

/// Runs waiting jobs in the order of WaitingJobs, within the number of slots and the limits of their sweeps. Each slot
/// is a thread that lives as long as the scheduler and runs one job at a time. A job that requests several threads gets
/// cores that no other job uses or waits for at its start: jobs side by side take precedence. Thread-safe.
class Scheduler {
 public:
  /// Dependencies; all outlive the scheduler.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    metrics::Metrics& metrics;
    JobRunner& runner;
    QueueHold& hold;
    Executor& executor;
  };

  /// `owner_max_running`: jobs of one owner that run at once; 0: no limit.
  explicit Scheduler(const Parts& parts, int owner_max_running = 0) : parts_(parts), waiting_(owner_max_running) {}
  ~Scheduler() { stop(); }
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// Adopts the workers that an earlier daemon left running, queues waiting jobs and those whose worker is gone, and
  /// starts the slots.
  void start(int slots);

  /// Queues jobs that are PENDING in the journal.
  void enqueue(const std::vector<store::QueuedJob>& jobs);

  /// A waiting job is CANCELLED on return; a running one is CANCELLING, with its worker notified. No effect on a job in
  /// either state. Throws ServiceError: not_found, or failed_precondition if it has ended otherwise.
  void cancel(std::int64_t job);

  /// Cancels the unfinished ones among the jobs. Waiting jobs leave the queue at once.
  void cancel_all(const std::vector<std::int64_t>& jobs);

  /// Removes jobs from the queue that are no longer PENDING in the journal.
  void forget(const std::vector<std::int64_t>& jobs);

  /// A waiting job is SUSPENDED on return; a running one is SUSPENDED or has ended. No effect on a SUSPENDED job.
  /// Throws ServiceError: not_found, failed_precondition if it has ended or is CANCELLING, or cancelled if `given_up`
  /// returns true first.
  void suspend(std::int64_t job, const std::function<bool()>& given_up);

  /// Queues a SUSPENDED job; no effect on a waiting or running one. Throws ServiceError: not_found, or
  /// failed_precondition.
  void resume(std::int64_t job);

  /// While `reason` is set, the disk is nearly full and no job runs: workers checkpoint their jobs, and none starts.
  void hold_for_low_disk(const std::optional<std::string>& reason);

  /// Wakes the slots to check the queue again after a change.
  void wake();

  [[nodiscard]] std::size_t waiting_count();

  /// Of this owner.
  [[nodiscard]] std::size_t waiting_count(const std::string& owner);

  /// Cores that a running job holds; 1 for a job about to run.
  [[nodiscard]] int cores_of(std::int64_t job);

  /// Has running workers checkpoint their jobs, and waits for the slots to finish. These jobs and the waiting ones are
  /// PENDING for the next daemon.
  void stop();

 private:
  /// A running job: requests to it, and its cores.
  struct Running {
    std::stop_source leave;
    std::stop_source suspend;
    std::stop_source cancel;
    int cores = 1;
  };

  /// Jobs whose workers an earlier daemon left running, and those to be ended; `run` adopts them.
  std::vector<store::QueuedJob> reconcile();
  void clean_up();
  void run_slot(const std::stop_token& stop);
  /// Waits for a change, at most until `limit`. REQUIRES: `lock` holds mutex_.
  void wait_for_change(MutexLock& lock, const std::stop_token& stop,
                       const std::optional<Hold::Clock::time_point>& limit) CELLCRUSH_REQUIRES(mutex_);
  /// Records that a job runs.
  Running& begin(std::int64_t job) CELLCRUSH_REQUIRES(mutex_);
  /// Runs the job on this thread. It holds one core, or more if it requests them and they are free. REQUIRES: `begin`
  /// was called for it. Does not throw.
  void run(const store::QueuedJob& taken, const std::stop_token& stop);
  int take_cores(const store::QueuedJob& job);
  store::StoredJob find(std::int64_t job);
  void tell_metrics() CELLCRUSH_REQUIRES(mutex_) { parts_.metrics.set_jobs(waiting_.count(), running_.size()); }

  Parts parts_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  WaitingJobs waiting_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::int64_t, Running> running_ CELLCRUSH_GUARDED_BY(mutex_);
  /// slots minus cores in use; negative after a restart with fewer
  int free_cores_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::uint64_t changes_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< number of events that slots wait for
  bool low_disk_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::vector<std::jthread> slots_;
};

}  // namespace cellcrush::jobs
