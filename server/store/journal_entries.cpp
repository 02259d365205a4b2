// How jobs and sweeps come into the journal and leave it.
#include <google/protobuf/util/time_util.h>

#include <utility>

#include "error.h"
#include "jobs/job_state.h"
#include "jobs/resource_name.h"
#include "store/job_bytes.h"
#include "store/journal.h"
#include "store/journal_schema.h"

namespace cellcrush::store {
namespace {

std::int64_t last_number(const Database& database) {
  Statement read(database, "SELECT last_insert_rowid()");
  read.step();
  return read.integer(0);
}

void bind_request(Statement& insert, int first, const std::string& request_id, const std::string& request_hash) {
  if (!request_id.empty()) insert.bind_text(first, request_id).bind_text(first + 1, request_hash);
}

// Sweeps keep what was asked for; their jobs and states are looked up.
std::string sweep_bytes(v1::Sweep sweep) {
  sweep.clear_name();
  sweep.clear_jobs();
  sweep.clear_state_counts();
  return sweep.SerializeAsString();
}

}  // namespace

Journal::Created Journal::create_job(v1::Job job, const std::string& request_id, const std::string& request_hash) {
  Created created;
  {
    const std::scoped_lock lock(write_mutex_);
    Transaction transaction(database_);
    if (const auto before = find_request("jobs", request_id, request_hash)) return {*before, false};
    created.job = insert_job(std::move(job), request_id, request_hash);
    transaction.commit();
  }
  on_durable_(created.job);
  return created;
}

Journal::CreatedSweep Journal::create_sweep(v1::Sweep sweep, const std::vector<SweepJob>& jobs,
                                            const std::string& request_id, const std::string& request_hash) {
  CreatedSweep created;
  {
    const std::scoped_lock lock(write_mutex_);
    Transaction transaction(database_);
    if (const auto before = find_request("sweeps", request_id, request_hash)) return {*before, {}, false};
    *sweep.mutable_create_time() = google::protobuf::util::TimeUtil::GetCurrentTime();
    Statement insert(database_,
                     "INSERT INTO sweeps (sweep, max_parallel, request_id, request_hash) VALUES (?1, ?2, ?3, ?4)");
    insert.bind_blob(1, sweep_bytes(sweep)).bind(2, sweep.max_parallel());
    bind_request(insert, 3, request_id, request_hash);
    insert.run();
    created.sweep = last_number(database_);
    Statement join(database_, "INSERT INTO sweep_jobs (sweep, position, job, point) VALUES (?1, ?2, ?3, ?4)");
    for (const auto& [job, values] : jobs) {
      v1::SweepTable::Row point;
      point.mutable_values()->Add(values.begin(), values.end());
      const auto position = static_cast<std::int64_t>(created.jobs.size());
      created.jobs.push_back(insert_job(job, "", ""));
      join.bind(1, created.sweep).bind(2, position).bind(3, created.jobs.back());
      join.bind_blob(4, point.SerializeAsString()).run();
    }
    transaction.commit();
  }
  for (const std::int64_t job : created.jobs) on_durable_(job);
  return created;
}

void Journal::cancel_waiting(const std::vector<std::int64_t>& jobs) {
  StateChange cancelled;
  cancelled.state = v1::CANCELLED;
  std::vector<std::int64_t> changed;
  {
    const std::scoped_lock lock(write_mutex_);
    Transaction transaction(database_);
    for (const std::int64_t job : jobs) {
      Statement read(database_, "SELECT 1 FROM jobs WHERE number = ?1 AND state = ?2");
      if (!read.bind(1, job).bind(2, v1::PENDING).step()) continue;
      write_change(job, cancelled);
      changed.push_back(job);
    }
    transaction.commit();
  }
  for (const std::int64_t job : changed) on_durable_(job);
}

void Journal::delete_job(std::int64_t job) {
  {
    const std::scoped_lock lock(write_mutex_);
    Transaction transaction(database_);
    {
      Statement read(database_, "SELECT state FROM jobs WHERE number = ?1");
      if (!read.bind(1, job).step())
        throw ServiceError(ServiceError::Kind::not_found, "There is no " + jobs::name_of(job) + ".");
      const auto state = static_cast<v1::JobState>(read.integer(0));
      if (!jobs::is_terminal(state)) {
        throw ServiceError(ServiceError::Kind::failed_precondition,
                           jobs::name_of(job) + " is " + v1::JobState_Name(state) +
                               " and cannot be deleted. Cancel it first, and delete it once it has ended.");
      }
    }
    for (const char* sql : {"DELETE FROM events WHERE job = ?1", "DELETE FROM meshes WHERE job = ?1",
                            "DELETE FROM sweep_jobs WHERE job = ?1", "DELETE FROM jobs WHERE number = ?1",
                            "INSERT INTO deleted_jobs (number) VALUES (?1)"})
      Statement(database_, sql).bind(1, job).run();
    transaction.commit();
  }
  on_durable_(job);
}

void Journal::note_folder_removed(std::int64_t job) {
  const std::scoped_lock lock(write_mutex_);
  Statement(database_, "DELETE FROM deleted_jobs WHERE number = ?1").bind(1, job).run();
}

std::optional<std::int64_t> Journal::find_request(const std::string& collection, const std::string& request_id,
                                                  const std::string& request_hash) {
  if (request_id.empty()) return std::nullopt;
  Statement find(database_, "SELECT number, request_hash FROM " + collection + " WHERE request_id = ?1");
  if (!find.bind_text(1, request_id).step()) return std::nullopt;
  if (find.bytes(1) == request_hash) return find.integer(0);
  throw ServiceError(ServiceError::Kind::already_exists,
                     "The request_id \"" + request_id + "\" was used for another request, which made " + collection +
                         "/" + std::to_string(find.integer(0)) + ". Use a new request_id.");
}

std::int64_t Journal::insert_job(v1::Job job, const std::string& request_id, const std::string& request_hash) {
  job.set_state(v1::PENDING);
  *job.mutable_create_time() = google::protobuf::util::TimeUtil::GetCurrentTime();
  Statement insert(database_,
                   "INSERT INTO jobs (state, job, submitted_case, request_id, request_hash, last_sequence) "
                   "VALUES (?1, ?2, ?3, ?4, ?5, 1)");
  insert.bind(1, job.state()).bind_blob(2, job_bytes(job)).bind_blob(3, job.case_().SerializeAsString());
  bind_request(insert, 4, request_id, request_hash);
  insert.run();
  const std::int64_t number = last_number(database_);
  insert_event(number, 1, kStateEvent, job_bytes(job));
  return number;
}

}  // namespace cellcrush::store
