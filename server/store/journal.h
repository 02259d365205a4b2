#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sweep.pb.h"
#include "clocks.h"
#include "mutex.h"
#include "store/change_count.h"
#include "store/group_commit.h"
#include "store/journal_schema.h"
#include "store/journal_upkeep.h"
#include "store/queued_job.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// Seconds during which daemons have served a journal. It advances with the machine's uptime while a daemon serves, and
/// stands still otherwise. The wall clock does not affect it, so that a wrong clock makes nothing old. Thread-safe.
class ServiceClock {
 public:
  /// `before`: seconds counted by earlier daemons.
  ServiceClock(std::int64_t before, Clocks::Source uptime)
      : before_(before), uptime_(std::move(uptime)), start_(uptime_()) {}

  [[nodiscard]] std::int64_t seconds() const {
    return before_ + std::chrono::duration_cast<std::chrono::seconds>(uptime_() - start_).count();
  }

 private:
  std::int64_t before_;
  Clocks::Source uptime_;
  std::chrono::nanoseconds start_;
};

/// A change of a job's state, with its details. Fields that do not apply stay empty.
struct StateChange {
  v1::Job::State state = v1::Job::JOB_STATE_UNSPECIFIED;
  v1::Job::Cause cause = v1::Job::JOB_CAUSE_UNSPECIFIED;
  std::string message;
  std::string remedy;
  std::int64_t worker_pid = 0;
  std::optional<v1::Summary> summary;  ///< present if there is a result
};

/// A job to create as part of a sweep. It is made when it is written: 100,000 jobs take 400 MB.
struct SweepJob {
  std::function<v1::Job()> job = [] { return v1::Job(); };  ///< case, labels, priority
  std::vector<double> values;                               ///< of the sweep's fields, in order
  std::int64_t element_steps = 0;                           ///< of the reference crush, which take as long as the run
};

/// What the journal stores of a result that another daemon made.
struct ImportedResult {
  v1::Job job;  ///< ended, with its case
  v1::Mesh mesh;
  std::int64_t samples = 0;
};

/// Writes the journal (journal_format.md) of a data folder. Thread-safe. Failures throw ServiceError; a failed write
/// changes nothing.
class Journal {
 public:
  /// Called for a job with new durable events, on the thread that wrote them.
  using Durable = std::function<void(std::int64_t job)>;

  /// Called once before something is created, but not if an earlier request created it. An exception propagates, and
  /// nothing is created. Must not call back into the journal.
  using Admit = std::function<void()>;
  using AdmitMany = std::function<void(std::size_t jobs)>;

  /// `uptime` advances the service clock.
  Journal(const std::filesystem::path& path, Durable on_durable, GroupCommit::Committed on_commit = {},
          Clocks::Source uptime = Clocks().uptime);
  /// Announces the samples that are gathered.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  struct Created {
    std::int64_t job = 0;
    bool is_new = true;
  };
  /// Creates a PENDING job from `job` (case, labels, priority, owner). Repeating the owner's request_id with the same
  /// hash returns the earlier job; with another hash it throws already_exists. An empty request_id means none.
  Created create_job(v1::Job job, const std::string& request_id, const std::string& request_hash,
                     std::int64_t element_steps = 0, const Admit& admit = {});

  /// Creates an ended job of each result, or none, and returns their numbers. Calls `put` for each, with its index,
  /// before it is durable; an exception propagates, and nothing is created.
  std::vector<std::int64_t> import_results(const std::vector<ImportedResult>& results,
                                           const std::function<void(std::size_t result, std::int64_t job)>& put);

  struct CreatedSweep {
    std::int64_t sweep = 0;
    std::vector<std::int64_t> jobs;  ///< in the order given; empty unless is_new
    bool is_new = true;
  };
  /// Creates a sweep and all its jobs, PENDING, or nothing. The request_id works as in create_job, among sweeps. The
  /// jobs of a large sweep come in several transactions, between which others write. The sweep stays hidden until the
  /// last: one whose creation was interrupted is left to Deletion::finish_sweeps.
  CreatedSweep create_sweep(v1::Sweep sweep, const std::vector<SweepJob>& jobs, const std::string& request_id,
                            const std::string& request_hash, const Admit& admit = {});

  /// Whether create_sweep is adding jobs to this hidden sweep.
  [[nodiscard]] bool is_being_created(std::int64_t sweep) const;

  /// Jobs of a sweep that one transaction creates.
  static constexpr std::size_t kCreatedAtOnce = 5000;

  /// Creates new PENDING jobs for those of the sweep that FAILED or were cancelled by max_failures. They replace the
  /// old jobs, which stay as jobs without a sweep. Returns the new jobs in the order of the points.
  std::vector<QueuedJob> retry_failed(std::int64_t sweep, const AdmitMany& admit = {});

  /// Sets the PENDING ones among the jobs to CANCELLED in one transaction. Returns them.
  std::vector<std::int64_t> cancel_waiting(const std::vector<std::int64_t>& jobs);

  /// Write the note of a job or a sweep in place of the one that the caller has read, and return whether it is another
  /// one. An ended job's note becomes part of its last event, that of any other job an event of its own. Throw
  /// ServiceError: not_found, aborted if the note is neither of the two, or data_loss for an unreadable row.
  bool set_note(std::int64_t job, const std::string& note, const std::string& previous);
  bool set_sweep_note(std::int64_t sweep, const std::string& note, const std::string& previous);

  /// Deletes an ended job with its events and its place in a sweep, and records that its folder must be deleted. Throws
  /// not_found, or failed_precondition if it has not ended.
  void delete_job(std::int64_t job);

  /// The same for the ended ones among the jobs, in one transaction. Returns them.
  std::vector<std::int64_t> delete_ended(const std::vector<std::int64_t>& jobs);

  /// Deletes these records.
  void note_folders_removed(const std::vector<std::int64_t>& jobs);

  /// Hides a sweep whose jobs have all ended: it can no longer be found or retried. No effect on a hidden sweep. Throws
  /// not_found, or failed_precondition naming jobs that have not ended.
  void begin_sweep_deletion(std::int64_t sweep);

  /// Deletes a hidden sweep without jobs.
  void end_sweep_deletion(std::int64_t sweep);

  /// Makes a state change durable, and the samples gathered for the job before it. Throws failed_precondition if the
  /// transition is not allowed (job_state.h). If a job FAILED and its sweep reaches max_failures, also sets the sweep's
  /// PENDING jobs to CANCELLED and returns them.
  std::vector<std::int64_t> change_state(std::int64_t job, const StateChange& change);

  /// Resets a job that is PENDING, RUNNING or SUSPENDED: its samples and mesh no longer count, and an event says `why`
  /// it restarts from step 0. A RUNNING job becomes PENDING. Sequence numbers continue; those of the samples are not
  /// reused. Throws ServiceError: not_found, data_loss for an unreadable row, or failed_precondition for a job in
  /// another state.
  void begin_again(std::int64_t job, const std::string& why);

  /// The job's reports have `count` samples since it last began. They become events within this time, together with
  /// those of other jobs: the reports are made durable, then the journal says how many samples count. Never waits for
  /// the disk. No effect unless the count exceeds the one before.
  void note_samples(std::int64_t job, std::int64_t count, std::chrono::milliseconds within = kSoon);

  /// Interval between checks for space to return to the disk.
  static constexpr std::chrono::milliseconds kUpkeepInterval{2000};

  /// For samples that somebody waits for, and for others: those that arrive meanwhile share a commit.
  static constexpr std::chrono::milliseconds kSoon{200};
  static constexpr std::chrono::milliseconds kLazyCommit{1000};

  /// Keeps a value beside the jobs, of which no watcher is told. Throws ServiceError.
  void set_fact(const std::string& name, const std::string& value) {
    writes_.run([&] { write_fact(database_, name, value); });
  }

  /// Returns once writers had their turn. Throws ServiceError if the journal takes no writes.
  void await_turn() { writes_.run({}); }

  /// On return, all samples noted before are durable, whichever thread does it.
  void commit_samples();

  void set_mesh(std::int64_t job, const v1::Mesh& mesh);

  [[nodiscard]] const Epoch& epoch() const { return epoch_; }

  /// Whether changes were lost before it was opened (ChangeCount), or a check of the file since then has found damage.
  /// Both are logged.
  [[nodiscard]] bool is_damaged() const { return lost_changes_ > 0 || upkeep_->has_found_damage(); }

  /// Seconds of the service clock (ServiceClock).
  [[nodiscard]] std::int64_t service_seconds() const { return clock_.seconds(); }

  /// Makes the service clock durable. A daemon that is killed loses the time served since the last call.
  void note_service_clock();

  /// An ended job, and the size of the files in its folder.
  struct Measured {
    std::int64_t job = 0;
    std::int64_t folder_bytes = 0;
  };
  /// Records the size of ended jobs, including their journal rows.
  void set_measured(const std::vector<Measured>& jobs);

 private:
  void note_lost_changes();
  void commit_gathered_when_due();
  // The rest is called by bodies of writes_.

  /// The job or sweep that an earlier request of this owner with this id created; nothing if there is none. Throws the
  /// errors of create_job.
  std::optional<std::int64_t> find_request(const std::string& collection, const std::string& owner,
                                           const std::string& request_id, const std::string& request_hash);
  /// Adds the next jobs of a sweep, at most kCreatedAtOnce.
  void insert_jobs(CreatedSweep& created, const std::vector<SweepJob>& jobs);
  /// A job and the number of its newest event.
  struct StoredState {
    v1::Job job;
    std::int64_t last_sequence = 0;
  };
  /// Throws ServiceError: not_found, data_loss for an unreadable row.
  StoredState read_state(std::int64_t job);
  void write_change(std::int64_t job, const StateChange& change);
  std::vector<std::int64_t> stop_failing_sweep(std::int64_t failed_job);
  std::vector<std::int64_t> jobs_of_sweep_in(std::int64_t sweep, v1::Job::State state);
  /// Deletes the rows of an ended job.
  void remove_job(std::int64_t job);

  static constexpr auto kNothingIsDue = std::chrono::steady_clock::time_point::max();
  class Creation;
  /// Numbers of samples by job.
  using Counts = std::map<std::int64_t, std::int64_t>;
  /// What is gathered for all jobs, or for one, in reports that are durable.
  Counts durable_samples(std::optional<std::int64_t> job);
  /// Makes events of the samples, unless the job has begun again meanwhile.
  void add_samples(const Counts& counts);
  /// Forgets what has been added, so that only later samples are gathered.
  void forget_gathered(const Counts& counts);

  std::filesystem::path data_folder_;
  Durable on_durable_;
  Database database_;
  ServiceClock clock_;
  ChangeCount changes_;
  std::int64_t lost_changes_ = 0;
  Epoch epoch_;
  GroupCommit writes_;  ///< every access to database_
  mutable Mutex creations_mutex_;
  std::set<std::int64_t> creations_ CELLCRUSH_GUARDED_BY(creations_mutex_);  ///< sweeps that create_sweep is adding
  Mutex gather_mutex_;
  Counts gathered_ CELLCRUSH_GUARDED_BY(gather_mutex_);  ///< samples that are not events yet
  std::chrono::steady_clock::time_point commit_at_ CELLCRUSH_GUARDED_BY(gather_mutex_) = kNothingIsDue;
  std::condition_variable_any sooner_;  ///< commit_at_ is earlier, or the journal closes
  bool stopping_ CELLCRUSH_GUARDED_BY(gather_mutex_) = false;
  std::thread committer_;
  std::optional<JournalUpkeep> upkeep_;
};

}  // namespace cellcrush::store
