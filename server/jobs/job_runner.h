#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "jobs/executor.h"
#include "jobs/queue_hold.h"
#include "jobs/state_writer.h"
#include "metrics/metrics.h"
#include "mutex.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::jobs {

/// Counts how often in a row the workers of a job were lost without getting further than their predecessors, and how
/// much more memory than predicted it needs. Thread-safe.
class LossCount {
 public:
  static constexpr int kMost = 3;
  static constexpr double kMoreMemory = 1.5;

  /// Adds a loss; `samples`: how many the job has. Whether the job may be retried; if not, its count is forgotten.
  bool may_retry(std::int64_t job, std::int64_t samples) {
    const MutexLock lock(mutex_);
    Losses& losses = losses_[job];
    if (samples > losses.samples) losses = {0, samples};
    if (++losses.count < kMost) return true;
    losses_.erase(job);
    return false;
  }

  /// Order.memory_factor of the next attempt.
  double memory_factor(std::int64_t job) {
    const MutexLock lock(mutex_);
    const auto found = memory_factors_.find(job);
    return found == memory_factors_.end() ? 1.0 : found->second;
  }

  void raise_memory(std::int64_t job) {
    const MutexLock lock(mutex_);
    memory_factors_.try_emplace(job, 1.0).first->second *= kMoreMemory;
  }

  void forget(std::int64_t job) {
    const MutexLock lock(mutex_);
    losses_.erase(job);
    memory_factors_.erase(job);
  }

 private:
  struct Losses {
    int count = 0;
    std::int64_t samples = 0;  ///< at the last loss
  };

  Mutex mutex_;
  std::map<std::int64_t, Losses> losses_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::int64_t, double> memory_factors_ CELLCRUSH_GUARDED_BY(mutex_);
};

/// Changes the state of a job. False if its present state does not allow that. Throws the other errors of the journal.
bool try_change(store::Journal& journal, std::int64_t job, const store::StateChange& change);

/// Runs a job in a worker and records the outcome in the journal. A job whose worker is lost waits for another, until
/// LossCount::kMost in a row have not got further than their predecessors. A last worker then makes a result from their
/// reports. The same happens if the worker of a cancelled job is gone. A shortage ends no job: the job returns to the
/// queue, and the queue is held. Thread-safe.
class JobRunner {
 public:
  /// Dependencies; all outlive the runner.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    watch::Hub& hub;
    Executor& executor;
    metrics::Metrics& metrics;
    QueueHold& hold;
    std::chrono::milliseconds checkpoint_interval;
    double longest_job_s;            ///< wall-clock limit of a job; 0: none
    std::int64_t most_memory_bytes;  ///< a raised limit of a job's memory does not exceed it; 0: none
    double step_cost = 0.0;          ///< of WorkerFacts; 0: not known
    /// Called with the waiting jobs that were CANCELLED because a job of their sweep failed.
    std::function<void(const std::vector<std::int64_t>&)> stopped = [](const auto&) {};
  };

  explicit JobRunner(const Parts& parts);

  /// Runs a PENDING job, or adopts its worker, until it has ended or was left. Returns whether it is PENDING again, to
  /// be retried. Retries writing the outcome until it succeeds or the daemon ends. Does not throw.
  bool run(std::int64_t job, int threads, const Interruptions& interruptions, const std::stop_token& daemons_end);

  /// What became of a job that an earlier daemon left RUNNING or CANCELLING.
  enum class Left {
    is_to_run,  ///< `run` adopts its live worker, or ends a cancelled job
    waits,      ///< PENDING, because its worker is gone
    ended,
  };
  /// Does not throw: what cannot be read or written now is left to `run`.
  Left reconcile(std::int64_t job);

  /// Kills the worker of a job that has ended otherwise, if any. Throws ServiceError.
  void end_leftover(std::int64_t job);

 private:
  /// Context of one run.
  struct Run {
    int threads;
    const Interruptions& interruptions;
    const std::stop_token& daemons_end;
    Trouble trouble;  ///< the shortage it met
    /// Of a job that begins on this machine; 0: of another one.
    double predicted_seconds = 0.0;
    double seconds = 0.0;  ///< that its worker took
  };

  worker::Order order_of(const store::StoredJob& stored) const;
  /// The state written: PENDING also if the job is to be rerun as is, CANCELLING if it was cancelled meanwhile.
  v1::Job::State run_once(std::int64_t job, Run& run);
  store::StateChange next_of(const store::StoredJob& stored, Run& run);
  /// The outcome for a job whose worker is gone; nothing if it was cancelled and must be given up.
  std::optional<store::StateChange> left_behind(const store::StoredJob& stored);
  WorkerExit run_worker(const store::StoredJob& stored, Run& run);
  double predict(const store::StoredJob& stored, int threads);
  WorkerEvents events_of(const store::StoredJob& stored);
  /// What has come of the reports, from the first on.
  struct Seen {
    std::int64_t last_step = -1;
    std::int64_t count = 0;      ///< of samples
    std::int64_t announced = 0;  ///< by runs before
  };
  void pass_on(std::int64_t job, Seen& seen, watch::Channel& channel, worker::Report& report);
  store::StateChange after(const store::StoredJob& stored, const WorkerExit& exit, Run& run);
  bool has_started(std::int64_t job);
  static store::StateChange before_start(const WorkerExit& exit);
  bool got_further(std::int64_t job);
  /// No state if the job was cancelled and the daemon ends: the next daemon gives it up.
  store::StateChange given_up(const store::StoredJob& stored, store::StateChange loss, Run& run);
  void end_leftover_if_possible(std::int64_t job);
  /// Discards what workers made of the job, in the journal and its folder, so that it restarts from step 0. Returns its
  /// state then: PENDING, CANCELLING if it was cancelled first, none if it was deleted. Throws ServiceError.
  v1::Job::State begin_again(std::int64_t job, const std::string& why);

  Parts parts_;
  LossCount losses_;
  StateWriter states_;
};

}  // namespace cellcrush::jobs
