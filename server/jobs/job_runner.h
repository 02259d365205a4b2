#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>

#include "jobs/executor.h"
#include "metrics/metrics.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::jobs {

/// Runs a job in a worker and writes in the journal what comes of it. A job whose worker is lost waits for another one, until
/// kMostLosses in a row have got no further than the one before; a last worker then makes a result of what they reported, as
/// it does when the worker of a cancelled job is gone. Thread-safe.
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
    std::chrono::milliseconds checkpoint_interval;
    double longest_job_s;  ///< clock time that a job's workers may take; 0: no limit
  };

  explicit JobRunner(const Parts& parts) : parts_(parts) {}

  /// Runs a job that is PENDING, or goes along with the worker that has it, until it has ended or was left. Whether it is
  /// PENDING again, to be tried again. What became of it is written until it can be, or the daemon ends.
  bool run(std::int64_t job, int threads, const Interruptions& interruptions, const std::stop_token& daemons_end);

  /// What became of a job that an earlier daemon left RUNNING or CANCELLING.
  enum class Left {
    is_to_run,  ///< its worker lives, and `run` goes along with it; or it was cancelled, and `run` ends it
    waits,      ///< it is PENDING, for its worker is gone
    ended,
  };
  Left reconcile(std::int64_t job);

  /// Ends the worker of a job that has ended otherwise, if there is one.
  void end_leftover(std::int64_t job);

 private:
  worker::Order order_of(const store::StoredJob& stored) const;
  /// The state that was written; PENDING also when the job is to be run again as it is, CANCELLING when another came first.
  v1::JobState run_once(std::int64_t job, int threads, const Interruptions& interruptions,
                        const std::stop_token& daemons_end);
  /// Whether it was cancelled and its worker is gone.
  bool is_left_cancelled(const store::StoredJob& stored);
  WorkerExit run_worker(const store::StoredJob& stored, int threads, const Interruptions& interruptions);
  WorkerEvents events_of(const store::StoredJob& stored);
  void pass_on(std::int64_t job, std::int64_t& last_step, watch::Channel& channel, worker::Report& report);
  store::StateChange after(const store::StoredJob& stored, const WorkerExit& exit, const Interruptions& interruptions,
                           const std::stop_token& daemons_end);
  bool got_further(std::int64_t job);
  /// No state when the job was cancelled and the daemon ends: the next one gives it up.
  store::StateChange given_up(const store::StoredJob& stored, store::StateChange loss,
                              const Interruptions& interruptions, const std::stop_token& daemons_end);
  /// Tries until it can be written or `stop` is requested; once when that cannot be. The state that was written, if one was;
  /// CANCELLING when the job is that and may not become what was to be written.
  v1::JobState write(std::int64_t job, store::StateChange change, const std::stop_token& stop);
  bool is_cancelling(std::int64_t job);
  void tidy_up(std::int64_t job, const store::StateChange& change);

  struct Losses {
    int count = 0;
    std::int64_t step = -1;  ///< of the newest sample at the last one
  };

  Parts parts_;
  std::mutex mutex_;
  std::map<std::int64_t, Losses> losses_;
};

}  // namespace cellcrush::jobs
