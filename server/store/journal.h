#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sweep.pb.h"
#include "mutex.h"
#include "store/epoch.h"
#include "store/group_commit.h"
#include "store/journal_upkeep.h"
#include "store/queued_job.h"
#include "store/service_clock.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// A change of a job's state and what is known with it. Fields that do not apply are left empty.
struct StateChange {
  v1::JobState state = v1::JOB_STATE_UNSPECIFIED;
  v1::JobCause cause = v1::JOB_CAUSE_UNSPECIFIED;
  std::string message;
  std::string remedy;
  std::int64_t worker_pid = 0;
  std::optional<v1::Summary> summary;  ///< present when there is a result
};

/// A job to be made as a part of a sweep.
struct SweepJob {
  v1::Job job;                     ///< case, labels, priority
  std::vector<double> values;      ///< of the sweep's fields, in their order
  std::int64_t element_steps = 0;  ///< elements times steps of its run
};

/// Writes the journal (journal_format.md). Thread-safe. Failures throw ServiceError; a failed write changes nothing.
class Journal {
 public:
  /// Told of a job that has new durable events, from the thread that wrote them.
  using Durable = std::function<void(std::int64_t job)>;

  /// Asked once before something new is made, and not for what an earlier request made. What it throws is passed on,
  /// and nothing is made; must not call back into the journal.
  using Admit = std::function<void()>;
  using AdmitMany = std::function<void(std::size_t jobs)>;

  /// `uptime` moves the service clock.
  Journal(const std::filesystem::path& path, Durable on_durable, GroupCommit::Committed on_commit = {},
          Clocks::Source uptime = Clocks().uptime);
  /// Commits what is gathered.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  struct Created {
    std::int64_t job = 0;
    bool is_new = true;
  };
  /// Makes a PENDING job from `job` (case, labels, priority, owner). The owner's same request_id with the same hash
  /// gives the job made before; with another one, already_exists is thrown. An empty request_id is none.
  Created create_job(v1::Job job, const std::string& request_id, const std::string& request_hash,
                     std::int64_t element_steps = 0, const Admit& admit = {});

  struct CreatedSweep {
    std::int64_t sweep = 0;
    std::vector<std::int64_t> jobs;  ///< in the order given; empty unless is_new
    bool is_new = true;
  };
  /// Makes a sweep and all its jobs, PENDING, or nothing. The request_id is that of create_job, among sweeps.
  CreatedSweep create_sweep(v1::Sweep sweep, const std::vector<SweepJob>& jobs, const std::string& request_id,
                            const std::string& request_hash, const Admit& admit = {});

  /// Makes new PENDING jobs of those of the sweep that FAILED or that max_failures cancelled. They take the places of
  /// the old ones, which stay as jobs without a sweep. Returns them in the order of the points.
  std::vector<QueuedJob> retry_failed(std::int64_t sweep, const AdmitMany& admit = {});

  /// Makes those of the jobs that are PENDING CANCELLED, all at once. Returns them.
  std::vector<std::int64_t> cancel_waiting(const std::vector<std::int64_t>& jobs);

  /// Removes a job that has ended, with its events and its place in a sweep, and notes that its folder is to be
  /// removed. Throws not_found, or failed_precondition when it has not ended.
  void delete_job(std::int64_t job);

  /// The same of those of the jobs that have ended, in one transaction. Returns them.
  std::vector<std::int64_t> delete_ended(const std::vector<std::int64_t>& jobs);

  /// Takes the notes away.
  void note_folders_removed(const std::vector<std::int64_t>& jobs);

  /// Hides a sweep whose jobs have all ended: it is found and retried no more. Nothing happens to one that is hidden
  /// already. Throws not_found, or failed_precondition, which names jobs that have not ended.
  void begin_sweep_deletion(std::int64_t sweep);

  /// Removes a hidden sweep that has no jobs any more.
  void end_sweep_deletion(std::int64_t sweep);

  /// Makes a change durable, and before it the samples gathered for the job. Throws failed_precondition when the state
  /// may not follow the present one (job_state.h). When a job of a sweep FAILED and its max_failures is reached, those
  /// of its jobs that are PENDING are CANCELLED with it, and returned.
  std::vector<std::int64_t> change_state(std::int64_t job, const StateChange& change);

  /// As the function of that name (begin_again.h), in one transaction; samples that are gathered for the job are
  /// dropped.
  void begin_again(std::int64_t job, const std::string& why);

  /// Gathers a sample, to be durable within that time, with all others that were gathered by then. Never waits for the
  /// disk. One whose step is not beyond that of the job's newest one is dropped: what is told again is there once.
  void append_sample(std::int64_t job, const v1::Sample& sample, std::chrono::milliseconds within = kSoon);

  /// Between two looks at what can be given back to the disk.
  static constexpr std::chrono::milliseconds kUpkeepInterval{2000};

  /// For samples that somebody waits for, and for those that nobody does: what comes meanwhile shares a commit.
  static constexpr std::chrono::milliseconds kSoon{200};
  static constexpr std::chrono::milliseconds kLazyCommit{1000};

  /// When it returns, all samples that were gathered before are durable, whoever wrote them.
  void commit_samples();

  void set_mesh(std::int64_t job, const v1::Mesh& mesh);

  [[nodiscard]] const Epoch& epoch() const { return epoch_; }

  /// Seconds of the service clock (service_clock.h).
  [[nodiscard]] std::int64_t service_seconds() const { return clock_.seconds(); }

  /// Makes durable how far the service clock is; a daemon that is killed loses what it served since.
  void note_service_clock();

  /// A job that has ended, and the bytes of what it left in its folder.
  struct Measured {
    std::int64_t job = 0;
    std::int64_t folder_bytes = 0;
  };
  /// Notes what ended jobs take, with their rows in the journal.
  void set_measured(const std::vector<Measured>& jobs);

 private:
  void commit_gathered_when_due();
  // These are for bodies of writes_.

  /// The job or sweep that an earlier request of that owner and id made; nothing when there was none. Throws as
  /// create_job does.
  std::optional<std::int64_t> find_request(const std::string& collection, const std::string& owner,
                                           const std::string& request_id, const std::string& request_hash);
  void write_change(std::int64_t job, const StateChange& change);
  std::vector<std::int64_t> stop_failing_sweep(std::int64_t failed_job);
  std::vector<std::int64_t> jobs_of_sweep_in(std::int64_t sweep, v1::JobState state);
  /// Removes the rows of a job that has ended.
  void remove_job(std::int64_t job);
  std::optional<std::int64_t> find_last_sequence(std::int64_t job);
  void insert_event(std::int64_t job, std::int64_t sequence, int kind, const std::string& payload);
  /// Step of the job's newest sample that can be read; -1 without any.
  std::int64_t find_newest_step(std::int64_t job);

  struct GatheredSample {
    std::int64_t step = 0;
    std::string bytes;
  };
  void insert_samples(std::int64_t job, const std::vector<GatheredSample>& samples);

  static constexpr auto kNothingIsDue = std::chrono::steady_clock::time_point::max();
  using Gathered = std::map<std::int64_t, std::vector<GatheredSample>>;
  class Taking;
  /// All that is gathered, or what is gathered for one job.
  Gathered take_gathered(std::optional<std::int64_t> job);
  void give_back(Gathered&& samples);

  Durable on_durable_;
  Database database_;
  ServiceClock clock_;
  Epoch epoch_;
  GroupCommit writes_;  ///< all that is done with database_
  Mutex gather_mutex_;
  Gathered gathered_ CELLCRUSH_GUARDED_BY(gather_mutex_);  ///< samples that nobody makes durable yet, by job
  /// Writers that may have taken some of them which are not durable yet.
  int takings_ CELLCRUSH_GUARDED_BY(gather_mutex_) = 0;
  std::chrono::steady_clock::time_point commit_at_ CELLCRUSH_GUARDED_BY(gather_mutex_) = kNothingIsDue;
  std::condition_variable_any sooner_;  ///< commit_at_ is earlier than it was, or the end has come
  bool stopping_ CELLCRUSH_GUARDED_BY(gather_mutex_) = false;
  std::thread committer_;
  std::optional<JournalUpkeep> upkeep_;
};

}  // namespace cellcrush::store
