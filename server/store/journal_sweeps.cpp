// How sweeps are added to the journal, and operations on several of their jobs.
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <utility>

#include "store/change_reader.h"
#include "store/job_rows.h"
#include "store/journal.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

// A sweep stores its request; its jobs and states are looked up.
std::string sweep_bytes(Database& database, v1::Sweep sweep) {
  sweep.clear_name();
  sweep.clear_jobs();
  sweep.clear_state_counts();
  return ContentWriter(database).of_sweep(std::move(sweep));
}

void note_request(Database& database, std::int64_t sweep, const std::string& request_id,
                  const std::string& request_hash) {
  if (request_id.empty()) return;
  Statement note(database, "UPDATE sweeps SET request_id = ?2, request_hash = ?3 WHERE number = ?1");
  note.bind(1, sweep).bind_text(2, request_id).bind_text(3, request_hash).run();
}

// The outcome of a waiting job whose sweep has failed too often.
StateChange stopped_by_failures(std::int64_t sweep, std::size_t failed, std::int64_t limit) {
  const std::string name = sweep_name_of(sweep);
  StateChange out;
  out.state = v1::Job::CANCELLED;
  out.message = (failed == 1 ? "1 job of " : std::to_string(failed) + " jobs of ") + name +
                " failed, reaching its max_failures of " + std::to_string(limit) + ", so this job was not started.";
  out.remedy = "Check the failed jobs, then queue them and this one again: cellcrush retry " + name + ".";
  return out;
}

// An ended job of a sweep, and its replacement.
struct Retry {
  v1::Job job;
  QueuedJob queued;  // of the ended job
};

std::vector<Retry> jobs_to_retry(Database& database, std::int64_t sweep) {
  Statement read(
      database,
      "SELECT jobs.number, jobs.job, jobs.submitted_case, jobs.element_steps, sweeps.max_parallel, "
      "jobs.checksum = jobs.expected_checksum AND jobs.case_checksum = row_checksum(jobs.submitted_case) "
      "FROM sweep_jobs JOIN jobs ON jobs.number = sweep_jobs.job JOIN sweeps ON sweeps.number = sweep_jobs.sweep "
      "WHERE sweep_jobs.sweep = ?1 AND NOT sweeps.deleting AND (jobs.state = ?2 OR (jobs.state = ?3 AND "
      "sweep_jobs.stopped)) "
      "ORDER BY sweep_jobs.position");
  read.bind(1, sweep).bind(2, v1::Job::FAILED).bind(3, v1::Job::CANCELLED);
  ContentReader contents(database);
  std::vector<Retry> out;
  while (read.step()) {
    auto& [job, queued] = out.emplace_back();
    if (read.integer(5) == 0 || !contents.read_case(read.bytes(2), *job.mutable_case_()))
      throw unreadable_entry(read.integer(0));
    v1::Job ended;
    ended.ParseFromString(read.bytes(1));
    *job.mutable_labels() = ended.labels();
    job.set_priority(ended.priority());
    job.set_time_limit_s(ended.time_limit_s());
    job.set_owner(ended.owner());
    job.set_executor(ended.executor().empty() ? kLocalExecutor : ended.executor());
    job.set_retry_of(name_of(read.integer(0)));
    job.set_sweep(sweep_name_of(sweep));
    queued = {
        read.integer(0), 0, ended.priority(), read.integer(3), sweep, static_cast<int>(read.integer(4)), ended.owner(),
        job.executor()};
  }
  return out;
}

}  // namespace

/// Marks a sweep whose creation takes several transactions, until the last has ended.
class Journal::Creation {
 public:
  explicit Creation(Journal& journal) : journal_(journal) {}
  ~Creation() {
    const MutexLock lock(journal_.creations_mutex_);
    journal_.creations_.erase(sweep_);
  }
  Creation(const Creation&) = delete;
  Creation& operator=(const Creation&) = delete;

  /// Before the sweep is in the journal.
  void begin(std::int64_t sweep) {
    sweep_ = sweep;
    const MutexLock lock(journal_.creations_mutex_);
    journal_.creations_.insert(sweep);
  }

 private:
  Journal& journal_;
  std::int64_t sweep_ = 0;
};

bool Journal::is_being_created(std::int64_t sweep) const {
  const MutexLock lock(creations_mutex_);
  return creations_.contains(sweep);
}

Journal::CreatedSweep Journal::create_sweep(v1::Sweep sweep, const std::vector<SweepJob>& jobs,
                                            const std::string& request_id, const std::string& request_hash,
                                            const Admit& admit) {
  CreatedSweep created;
  Creation creation(*this);
  const bool in_parts = jobs.size() > kCreatedAtOnce;
  writes_.run([&] {
    if (const auto before = find_request("sweeps", sweep.owner(), request_id, request_hash)) {
      created = {*before, {}, false};
      return;
    }
    if (admit) admit();
    *sweep.mutable_create_time() = google::protobuf::util::TimeUtil::GetCurrentTime();
    Statement insert(database_,
                     "INSERT INTO sweeps (sweep, max_parallel, max_failures, owner, deleting) "
                     "VALUES (?1, ?2, ?3, ?4, ?5)");
    insert.bind_blob(1, sweep_bytes(database_, sweep)).bind(2, sweep.max_parallel()).bind(3, sweep.max_failures());
    insert.bind_text(4, sweep.owner()).bind(5, in_parts ? 1 : 0).run();
    created.sweep = database_.last_number();
    if (in_parts) creation.begin(created.sweep);
    insert_jobs(created, jobs);
    if (!in_parts) note_request(database_, created.sweep, request_id, request_hash);
  });
  while (created.is_new && created.jobs.size() < jobs.size()) {
    writes_.run([&] { insert_jobs(created, jobs); });
  }
  if (created.is_new && in_parts) {
    writes_.run([&] {
      // The same request may have come twice at once. The sweep of the second stays hidden and is deleted.
      if (const auto before = find_request("sweeps", sweep.owner(), request_id, request_hash)) {
        created = {*before, {}, false};
        return;
      }
      note_request(database_, created.sweep, request_id, request_hash);
      Statement(database_, "UPDATE sweeps SET deleting = 0 WHERE number = ?1").bind(1, created.sweep).run();
      Statement note(database_, "INSERT INTO changes (kind, resource, sequence) VALUES (?1, ?2, 0)");
      note.bind(1, static_cast<std::int64_t>(ChangeKind::sweep_changed)).bind(2, created.sweep).run();
    });
  }
  for (const std::int64_t job : created.jobs) on_durable_(job);
  return created;
}

void Journal::insert_jobs(CreatedSweep& created, const std::vector<SweepJob>& jobs) {
  JobInserter inserter(database_);
  Statement join(database_, "INSERT INTO sweep_jobs (sweep, position, job, point) VALUES (?1, ?2, ?3, ?4)");
  const std::size_t end = std::min(created.jobs.size() + kCreatedAtOnce, jobs.size());
  JobEntry entry;
  while (created.jobs.size() < end) {
    const auto position = static_cast<std::int64_t>(created.jobs.size());
    const SweepJob& made = jobs[created.jobs.size()];
    v1::SweepTable::Row point;
    point.mutable_values()->Add(made.values.begin(), made.values.end());
    entry.element_steps = made.element_steps;
    if (!created.jobs.empty()) entry.submission = created.jobs.front();
    v1::Job job = made.job();
    job.set_sweep(sweep_name_of(created.sweep));
    created.jobs.push_back(inserter.insert(std::move(job), entry));
    join.bind(1, created.sweep).bind(2, position).bind(3, created.jobs.back());
    join.bind_blob(4, point.SerializeAsString()).run();
  }
}

std::vector<QueuedJob> Journal::retry_failed(std::int64_t sweep, const AdmitMany& admit) {
  std::vector<QueuedJob> retried;
  writes_.run([&] {
    JobInserter inserter(database_);
    Statement replace(database_, "UPDATE sweep_jobs SET job = ?2, stopped = 0 WHERE job = ?1");
    const auto again = jobs_to_retry(database_, sweep);
    if (admit && !again.empty()) admit(again.size());
    for (const auto& failed : again) {
      QueuedJob queued = failed.queued;
      JobEntry entry;
      entry.element_steps = queued.element_steps;
      if (!retried.empty()) entry.submission = retried.front().job;
      queued.job = inserter.insert(failed.job, entry);
      queued.submission = entry.submission.value_or(queued.job);
      replace.bind(1, failed.queued.job).bind(2, queued.job).run();
      retried.push_back(queued);
    }
  });
  for (const auto& job : retried) on_durable_(job.job);
  return retried;
}

std::vector<std::int64_t> Journal::stop_failing_sweep(std::int64_t failed_job) {
  Statement find(database_,
                 "SELECT sweeps.number, sweeps.max_failures FROM sweep_jobs JOIN sweeps "
                 "ON sweeps.number = sweep_jobs.sweep WHERE sweep_jobs.job = ?1 AND sweeps.max_failures > 0");
  if (!find.bind(1, failed_job).step()) return {};
  const std::int64_t sweep = find.integer(0);
  const std::int64_t limit = find.integer(1);
  const auto failed = jobs_of_sweep_in(sweep, v1::Job::FAILED);
  if (static_cast<std::int64_t>(failed.size()) < limit) return {};
  auto waiting = jobs_of_sweep_in(sweep, v1::Job::PENDING);
  Statement mark(database_, "UPDATE sweep_jobs SET stopped = 1 WHERE job = ?1");
  for (const std::int64_t job : waiting) {
    write_change(job, stopped_by_failures(sweep, failed.size(), limit));
    mark.bind(1, job).run();
  }
  return waiting;
}

std::vector<std::int64_t> Journal::jobs_of_sweep_in(std::int64_t sweep, v1::Job::State state) {
  Statement read(database_,
                 "SELECT jobs.number FROM sweep_jobs JOIN jobs ON jobs.number = sweep_jobs.job "
                 "WHERE sweep_jobs.sweep = ?1 AND jobs.state = ?2 ORDER BY sweep_jobs.position");
  return read.bind(1, sweep).bind(2, state).numbers();
}

std::vector<std::int64_t> Journal::cancel_waiting(const std::vector<std::int64_t>& jobs) {
  StateChange cancelled;
  cancelled.state = v1::Job::CANCELLED;
  std::vector<std::int64_t> changed;
  writes_.run([&] {
    for (const std::int64_t job : jobs) {
      Statement read(database_, "SELECT 1 FROM jobs WHERE number = ?1 AND state = ?2");
      if (!read.bind(1, job).bind(2, v1::Job::PENDING).step()) continue;
      write_change(job, cancelled);
      changed.push_back(job);
    }
  });
  for (const std::int64_t job : changed) on_durable_(job);
  return changed;
}

}  // namespace cellcrush::store
