#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "jobs/executor.h"
#include "jobs/waiting_jobs.h"
#include "metrics/metrics.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::jobs {

/// Runs waiting jobs in the order of WaitingJobs, at most as many at once as there are slots and as their sweeps allow. Each slot is a thread that lives as
/// long as the scheduler and runs one job at a time. Jobs that ask for several threads get those cores that no other job
/// uses or waits for when they start: side by side comes first. Thread-safe.
class Scheduler {
 public:
  /// What the scheduler works with; all of it outlives the scheduler.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    watch::Hub& hub;
    Executor& executor;
    metrics::Metrics& metrics;
  };

  explicit Scheduler(const Parts& parts) : parts_(parts) {}
  ~Scheduler() { stop(); }
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// Marks the jobs that an earlier daemon left running as lost, queues those that wait, and starts the slots.
  void start(int slots);

  /// Queues jobs that are PENDING in the journal.
  void enqueue(const std::vector<store::QueuedJob>& jobs);

  /// A job that waits is CANCELLED when this returns; one that runs is CANCELLING, and its worker is told. Nothing
  /// happens to one that is either already. Throws ServiceError: not_found, or failed_precondition when it has ended
  /// otherwise.
  void cancel(std::int64_t job);

  /// Cancels those of the jobs that have not ended.
  void cancel_all(const std::vector<std::int64_t>& jobs);

  /// Ends running workers, marks their jobs as lost, and waits until the slots are done. Jobs that wait stay PENDING.
  void stop();

 private:
  void fail_lost_jobs();
  void run_slot(const std::stop_token& stop);
  /// Adds those that it takes to the cores of the slot.
  void run_job(std::int64_t job, int& cores, const std::stop_token& stop);
  WorkerExit run_worker(const store::StoredJob& stored, int threads, const Interruptions& interruptions);
  int take_cores(int asked);
  /// REQUIRES: mutex_ is held.
  void tell_metrics() { parts_.metrics.set_jobs(waiting_.count(), running_.size()); }
  void pass_on(std::int64_t job, watch::Channel& channel, const worker::Report& report);
  void finish(std::int64_t job, const store::StateChange& outcome, const std::stop_token& stop);

  Parts parts_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  WaitingJobs waiting_;
  std::map<std::int64_t, std::stop_source> running_;  ///< to cancel jobs that are in a slot
  int free_cores_ = 0;                                ///< one for each slot, and those that jobs use are taken off
  std::vector<std::jthread> slots_;
};

}  // namespace cellcrush::jobs
