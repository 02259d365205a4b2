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

/// Runs the waiting jobs of one executor in the order of WaitingJobs, within the number of slots and the limits of
/// their sweeps and owners. Each running job has a thread, and one more waits for the next job. On the daemon's machine
/// a job that requests several threads gets cores that no other job uses or waits for at its start: jobs side by side
/// take precedence. Elsewhere it gets as many threads as it requests. A scheduler that is not started keeps its queue
/// and runs nothing. Thread-safe.
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
    std::string executor_name = store::kLocalExecutor;
  };

  /// `owner_max_running`: jobs of one owner that run at once; 0: no limit.
  explicit Scheduler(const Parts& parts, int owner_max_running = 0) : parts_(parts), waiting_(owner_max_running) {}
  ~Scheduler() { stop(); }
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// Adopts what an earlier daemon left to the executor: running workers and, elsewhere than on this machine, jobs that
  /// have not started there. Queues the other waiting jobs and those whose worker is gone, and starts the slots.
  void start(int slots);

  /// Queues jobs that are PENDING in the journal.
  void enqueue(const std::vector<store::QueuedJob>& jobs);

  /// A waiting job is CANCELLED on return; a running one is CANCELLING, with its worker notified. No effect on a job in
  /// either state. Throws ServiceError: not_found, or failed_precondition if it has ended otherwise.
  void cancel(std::int64_t job);

  /// Removes CANCELLED jobs from the queue, and has the executor drop those that it has not started.
  void forget(const std::vector<std::int64_t>& jobs);
  /// Ends what the executor still computes of a job that has ended while nobody followed it, as a job of a cluster that
  /// returned to the queue for a shortage. REQUIRES: a job of this executor. Does not throw.
  void end_unfollowed(std::int64_t job);

  /// Removes jobs from the queue that are about to be cancelled. Those that it holds running stay.
  void dequeue(const std::vector<std::int64_t>& jobs);

  /// Queues jobs that `dequeue` removed and that are still PENDING.
  void requeue(const std::vector<store::QueuedJob>& jobs);

  /// A waiting job is SUSPENDED on return; a running one is SUSPENDED or has ended. No effect on a SUSPENDED job.
  /// Throws ServiceError: not_found, failed_precondition if it has ended or is CANCELLING, or cancelled if `given_up`
  /// returns true first.
  void suspend(std::int64_t job, const std::function<bool()>& given_up);

  /// Queues a SUSPENDED job; no effect on a waiting or running one. Throws ServiceError: not_found, or
  /// failed_precondition.
  void resume(std::int64_t job);

  /// While `reason` is set, the disk is nearly full and no job runs: workers checkpoint their jobs, and none starts.
  void hold_for_low_disk(const std::optional<std::string>& reason);

  /// Has the queue checked again after a change.
  void wake();

  [[nodiscard]] std::size_t waiting_count();

  /// Of this owner.
  [[nodiscard]] std::size_t waiting_count(const std::string& owner);

  /// Adds its jobs to the others.
  void add_load(Load& to);

  /// Cores that a running job computes on; 1 for a job about to run.
  [[nodiscard]] int cores_of(std::int64_t job);

  /// Has running workers checkpoint their jobs.
  void begin_stop();

  /// The same, and waits for the threads to finish. These jobs and the waiting ones are PENDING for the next daemon.
  void stop();

 private:
  /// A running job: requests to it, and its cores.
  struct Running {
    std::stop_source leave;
    std::stop_source suspend;
    std::stop_source cancel;
    int cores = 1;
  };

  /// Jobs that an earlier daemon left running or to the executor, and those to be ended; `run` adopts them.
  std::vector<store::QueuedJob> reconcile();
  /// Whether the executor has the job, which no worker has started.
  bool is_placed(std::int64_t job);
  void adopt(const store::QueuedJob& job, std::vector<store::QueuedJob>& adopted);
  /// On a thread of its own.
  void spawn(std::function<void()> work) CELLCRUSH_REQUIRES(mutex_);
  /// Waits for a job, has another thread wait in its place, and runs it.
  void run_next();
  /// False if there can be no further thread now.
  bool spawn_next() CELLCRUSH_REQUIRES(mutex_);
  /// Waits for a change, at most until `limit`. REQUIRES: `lock` holds mutex_.
  void wait_for_change(MutexLock& lock, const std::optional<Hold::Clock::time_point>& limit) CELLCRUSH_REQUIRES(mutex_);
  /// Records that a job runs.
  void begin(std::int64_t job) CELLCRUSH_REQUIRES(mutex_);
  /// Runs the job on this thread. REQUIRES: `begin` was called for it. Does not throw.
  void run(const store::QueuedJob& taken);
  /// Cores for a starting job beside its first.
  int take_cores(const store::QueuedJob& job);
  /// How many of free_cores_ a job on this many cores holds.
  [[nodiscard]] int held_by(int cores) const { return shares_cores() ? cores : 1; }
  /// Whether running jobs share the cores of this machine.
  [[nodiscard]] bool shares_cores() const { return parts_.executor_name == store::kLocalExecutor; }
  /// Asks the run of the job, if there is one, to end.
  void cancel_run(std::int64_t job);
  /// Waits until the run of a SUSPENDED job has ended, which takes moments.
  void wait_for_end(std::int64_t job);
  store::StoredJob find(std::int64_t job);
  void tell_metrics() CELLCRUSH_REQUIRES(mutex_) {
    parts_.metrics.set_jobs(parts_.executor_name, waiting_.count(), running_.size());
  }

  Parts parts_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  WaitingJobs waiting_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::int64_t, Running> running_ CELLCRUSH_GUARDED_BY(mutex_);
  /// slots minus what running jobs hold of them; negative after a restart with fewer
  int free_cores_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::uint64_t changes_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< number of events that may let a job start
  bool low_disk_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::stop_source end_;  ///< of all threads
  std::map<std::thread::id, std::jthread> threads_ CELLCRUSH_GUARDED_BY(mutex_);
  std::vector<std::jthread> ended_ CELLCRUSH_GUARDED_BY(mutex_);  ///< or about to
};

}  // namespace cellcrush::jobs
