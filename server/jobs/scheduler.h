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

/// Runs waiting jobs in the order of WaitingJobs, at most as many at once as there are slots and as their sweeps allow.
/// Each slot is a thread that lives as long as the scheduler and runs one job at a time. Jobs that ask for several
/// threads get those cores that no other job uses or waits for when they start: side by side comes first. Thread-safe.
class Scheduler {
 public:
  /// What the scheduler works with; all of it outlives the scheduler.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    metrics::Metrics& metrics;
    JobRunner& runner;
    QueueHold& hold;
    Executor& executor;
  };

  /// `owner_max_running`: jobs of one owner that run at once; 0: any number.
  explicit Scheduler(const Parts& parts, int owner_max_running = 0) : parts_(parts), waiting_(owner_max_running) {}
  ~Scheduler() { stop(); }
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// Goes along with the workers that an earlier daemon left running, queues the jobs that wait and those whose worker
  /// is gone, and starts the slots.
  void start(int slots);

  /// Queues jobs that are PENDING in the journal.
  void enqueue(const std::vector<store::QueuedJob>& jobs);

  /// A job that waits is CANCELLED when this returns; one that runs is CANCELLING, and its worker is told. Nothing
  /// happens to one that is either already. Throws ServiceError: not_found, or failed_precondition when it has ended
  /// otherwise.
  void cancel(std::int64_t job);

  /// Cancels those of the jobs that have not ended. Those that wait leave the queue at once.
  void cancel_all(const std::vector<std::int64_t>& jobs);

  /// Takes jobs that are PENDING in the journal no more out of the queue.
  void forget(const std::vector<std::int64_t>& jobs);

  /// A job that waits is SUSPENDED when this returns; one that runs is, too, or has ended. Nothing happens to one that
  /// is SUSPENDED already. Throws ServiceError: not_found, failed_precondition when it has ended or is CANCELLING, or
  /// cancelled when `given_up` says so first.
  void suspend(std::int64_t job, const std::function<bool()>& given_up);

  /// Queues a job that is SUSPENDED; nothing happens to one that waits or runs. Throws ServiceError: not_found, or
  /// failed_precondition.
  void resume(std::int64_t job);

  /// While there is a reason, the disk has too little room and no job runs: workers leave theirs at a checkpoint, and
  /// none starts.
  void hold_for_low_disk(const std::optional<std::string>& reason);

  /// Lets the slots look at the queue again: something has changed.
  void wake();

  [[nodiscard]] std::size_t waiting_count();

  /// Of that owner.
  [[nodiscard]] std::size_t waiting_count(const std::string& owner);

  /// Cores that a job which runs holds; 1 for one that is about to.
  [[nodiscard]] int cores_of(std::int64_t job);

  /// Lets running workers leave their jobs at a checkpoint, and waits until the slots are done. These jobs and those
  /// that wait are PENDING for the next daemon.
  void stop();

 private:
  /// A job that runs: what others wish of it, and what it holds.
  struct Running {
    std::stop_source leave;
    std::stop_source suspend;
    std::stop_source cancel;
    int cores = 1;
  };

  /// Returns the jobs whose workers an earlier daemon left running, and those that are to be ended; `run` follows
  /// them.
  std::vector<store::QueuedJob> reconcile();
  void clean_up();
  void run_slot(const std::stop_token& stop);
  /// Waits for a change, at most until `limit`. REQUIRES: `lock` holds mutex_.
  void wait_for_change(MutexLock& lock, const std::stop_token& stop,
                       const std::optional<Hold::Clock::time_point>& limit) CELLCRUSH_REQUIRES(mutex_);
  /// Notes that a job runs.
  Running& begin(std::int64_t job) CELLCRUSH_REQUIRES(mutex_);
  /// Has the job run by this thread; it holds a core, and more if it asks for them and there are. REQUIRES: `begin` was
  /// called for it. Throws nothing.
  void run(const store::QueuedJob& taken, const std::stop_token& stop);
  int take_cores(const store::QueuedJob& job);
  store::StoredJob find(std::int64_t job);
  void tell_metrics() CELLCRUSH_REQUIRES(mutex_) { parts_.metrics.set_jobs(waiting_.count(), running_.size()); }

  Parts parts_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  WaitingJobs waiting_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::int64_t, Running> running_ CELLCRUSH_GUARDED_BY(mutex_);
  /// One for each slot, and those that jobs use are taken off; below 0 after a restart with fewer.
  int free_cores_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::uint64_t changes_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< of what the slots wait for
  bool low_disk_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::vector<std::jthread> slots_;
};

}  // namespace cellcrush::jobs
