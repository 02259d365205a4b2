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
#include "metrics/metrics.h"
#include "mutex.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::jobs {

/// Runs a job in a worker and writes in the journal what comes of it. A job whose worker is lost waits for another one,
/// until kMostLosses in a row have got no further than the one before; a last worker then makes a result of what they
/// reported, as it does when the worker of a cancelled job is gone. A shortage ends no job: the job waits again as it
/// was, and the queue is held. Thread-safe.
class JobRunner {
 public:
  static constexpr int kMostLosses = 3;

  /// What the runner works with; all of it outlives the runner.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    watch::Hub& hub;
    Executor& executor;
    metrics::Metrics& metrics;
    QueueHold& hold;
    std::chrono::milliseconds checkpoint_interval;
    double longest_job_s;  ///< clock time that a job's workers may take; 0: no limit
    /// Called with the jobs that were CANCELLED, while they waited, because a job of their sweep failed.
    std::function<void(const std::vector<std::int64_t>&)> stopped = [](const auto&) {};
  };

  explicit JobRunner(const Parts& parts) : parts_(parts) {}

  /// Runs a job that is PENDING, or goes along with the worker that has it, until it has ended or was left. Whether it
  /// is PENDING again, to be tried again. What became of it is written until it can be, or the daemon ends. Throws
  /// nothing.
  bool run(std::int64_t job, int threads, const Interruptions& interruptions, const std::stop_token& daemons_end);

  /// What became of a job that an earlier daemon left RUNNING or CANCELLING.
  enum class Left {
    is_to_run,  ///< its worker lives, and `run` goes along with it; or it was cancelled, and `run` ends it
    waits,      ///< it is PENDING, for its worker is gone
    ended,
  };
  /// Throws nothing: what cannot be found out or written now is for `run`.
  Left reconcile(std::int64_t job);

  /// Ends the worker of a job that has ended otherwise, if there is one. Throws ServiceError.
  void end_leftover(std::int64_t job);

 private:
  /// What a run needs beside the job.
  struct Run {
    int threads;
    const Interruptions& interruptions;
    const std::stop_token& daemons_end;
    Trouble trouble;  ///< the shortage that it met
  };

  worker::Order order_of(const store::StoredJob& stored) const;
  /// The state that was written; PENDING also when the job is to be run again as it is, CANCELLING when another came
  /// first.
  v1::JobState run_once(std::int64_t job, Run& run);
  store::StateChange next_of(const store::StoredJob& stored, Run& run);
  /// What becomes of a job whose worker is gone; nothing when it was cancelled and is to be given up.
  std::optional<store::StateChange> left_behind(const store::StoredJob& stored);
  WorkerExit run_worker(const store::StoredJob& stored, const Run& run);
  WorkerEvents events_of(const store::StoredJob& stored);
  void pass_on(std::int64_t job, std::int64_t& last_step, watch::Channel& channel, worker::Report& report);
  store::StateChange after(const store::StoredJob& stored, const WorkerExit& exit, Run& run);
  bool got_further(std::int64_t job);
  /// No state when the job was cancelled and the daemon ends: the next one gives it up.
  store::StateChange given_up(const store::StoredJob& stored, store::StateChange loss, Run& run);
  /// Lets a job wait again that has met a shortage. The state that it is in then: one that was cancelled is CANCELLING.
  v1::JobState put_back(std::int64_t job, const Run& run);
  /// Tries until it can be written or the daemon ends. The state that was written, if one was; CANCELLING when the job
  /// is that and may not become what was to be written.
  v1::JobState write(std::int64_t job, const store::StateChange& change, const std::stop_token& daemons_end);
  /// Nothing when it cannot be written for now. `logged`: why not, the last time, which is logged once.
  std::optional<v1::JobState> try_write(std::int64_t job, const store::StateChange& change, std::string& logged);
  void end_leftover_if_possible(std::int64_t job);
  /// Drops what workers have made of the job, in the journal and its folder, so that it is run again from step 0. The
  /// state it then has: PENDING, CANCELLING when a cancel came first, none when it was deleted. Throws ServiceError.
  v1::JobState begin_again(std::int64_t job, const std::string& why);
  void tidy_up(std::int64_t job, const store::StateChange& change);

  struct Losses {
    int count = 0;
    std::int64_t step = -1;  ///< of the newest sample at the last one
  };

  Parts parts_;
  Mutex mutex_;
  std::map<std::int64_t, Losses> losses_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::jobs
