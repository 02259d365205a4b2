// How jobs and sweeps are added to the journal and deleted from it, its size, and the service clock.
#include <string>
#include <utility>

#include "access/token_file.h"
#include "access/unix_user.h"
#include "error.h"
#include "store/job_rows.h"
#include "store/job_state.h"
#include "store/journal.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

std::optional<v1::Job::State> find_state(Database& database, std::int64_t job) {
  Statement read(database, "SELECT state, checksum = expected_checksum FROM jobs WHERE number = ?1");
  if (!read.bind(1, job).step()) return std::nullopt;
  if (read.integer(1) == 0) throw unreadable_entry(job);
  return static_cast<v1::Job::State>(read.integer(0));
}

constexpr std::size_t kNamedJobs = 5;

// "jobs/3 is RUNNING, jobs/4 is PENDING and 7 more"; empty when all jobs of the sweep have ended.
std::string unended_jobs(Database& database, std::int64_t sweep) {
  Statement read(database,
                 "SELECT jobs.number, jobs.state FROM sweep_jobs JOIN jobs ON jobs.number = sweep_jobs.job "
                 "WHERE sweep_jobs.sweep = ?1 ORDER BY sweep_jobs.position");
  read.bind(1, sweep);
  std::string out;
  std::size_t count = 0;
  while (read.step()) {
    const auto state = static_cast<v1::Job::State>(read.integer(1));
    if (is_terminal(state) || ++count > kNamedJobs) continue;
    out += (count == 1 ? "" : ", ") + name_of(read.integer(0)) + " is " + v1::Job::State_Name(state);
  }
  return count > kNamedJobs ? out + " and " + std::to_string(count - kNamedJobs) + " more" : out;
}

}  // namespace

Journal::Created Journal::create_job(v1::Job job, const std::string& request_id, const std::string& request_hash,
                                     std::int64_t element_steps, const Admit& admit) {
  Created created;
  writes_.run([&] {
    if (const auto before = find_request("jobs", job.owner(), request_id, request_hash)) {
      created = {*before, false};
    } else {
      if (admit) admit();
      created.job = JobInserter(database_).insert(std::move(job), {request_id, request_hash, {}, element_steps});
    }
  });
  if (created.is_new) on_durable_(created.job);
  return created;
}

// The events are those of a job that ran: its samples follow the state RUNNING.
std::vector<std::int64_t> Journal::import_results(
    const std::vector<ImportedResult>& results, const std::function<void(std::size_t result, std::int64_t job)>& put) {
  std::vector<std::int64_t> created;
  writes_.run([&] {
    created.clear();
    for (const auto& result : results) {
      const std::int64_t job = JobInserter(database_).insert(result.job, {});
      put(created.size(), job);
      created.push_back(job);
      Statement update(database_, "UPDATE jobs SET samples = ?2, ended_at = ?3 WHERE number = ?1");
      update.bind(1, job).bind(2, result.samples).bind(3, clock_.seconds()).run();
      v1::Job ended = result.job;
      ended.clear_state_time();  // an import is no end of which anybody is told
      v1::Job state = ended;
      state.clear_summary();
      state.clear_end_time();
      state.clear_cause();
      state.clear_cause_message();
      state.clear_remedy();
      std::int64_t sequence = 2;
      state.set_state(v1::Job::RUNNING);
      add_state(database_, job, state, sequence);
      sequence += result.samples;
      if (result.job.state() == v1::Job::CANCELLED) {
        state.set_state(v1::Job::CANCELLING);
        add_state(database_, job, state, ++sequence);
      }
      add_state(database_, job, ended, ++sequence);
      insert_mesh(database_, job, result.mesh);
    }
  });
  for (const std::int64_t job : created) on_durable_(job);
  return created;
}

void Journal::delete_job(std::int64_t job) {
  writes_.run([&] {
    const auto state = find_state(database_, job);
    if (!state) throw ServiceError(ServiceError::Kind::not_found, "There is no " + name_of(job) + ".");
    if (!is_terminal(*state)) {
      throw ServiceError(ServiceError::Kind::failed_precondition,
                         name_of(job) + " is " + v1::Job::State_Name(*state) +
                             " and cannot be deleted. Cancel it, then delete it once it has ended.");
    }
    remove_job(job);
  });
  on_durable_(job);
}

std::vector<std::int64_t> Journal::delete_ended(const std::vector<std::int64_t>& jobs) {
  std::vector<std::int64_t> deleted;
  writes_.run([&] {
    deleted.clear();
    for (const std::int64_t job : jobs) {
      const auto state = find_state(database_, job);
      if (!state || !is_terminal(*state)) continue;
      remove_job(job);
      deleted.push_back(job);
    }
  });
  for (const std::int64_t job : deleted) on_durable_(job);
  return deleted;
}

void Journal::remove_job(std::int64_t job) {
  remove_rows(database_, job);
  Statement(database_, "INSERT INTO deleted_jobs (number) VALUES (?1)").bind(1, job).run();
}

void Journal::note_folders_removed(const std::vector<std::int64_t>& jobs) {
  writes_.run([&] {
    Statement remove(database_, "DELETE FROM deleted_jobs WHERE number = ?1");
    for (const std::int64_t job : jobs) remove.bind(1, job).run();
  });
}

// What this user made with an earlier version has no owner, or kLocal.
std::optional<std::int64_t> Journal::find_request(const std::string& collection, const std::string& owner,
                                                  const std::string& request_id, const std::string& request_hash) {
  if (request_id.empty()) return std::nullopt;
  Statement find(database_,
                 "SELECT number, request_hash FROM " + collection +
                     " WHERE request_id = ?1 AND owner IN (?2, ?3, ?4) ORDER BY owner = ?2 DESC, owner DESC");
  const bool is_own = owner == access::own_user();
  find.bind_text(1, request_id).bind_text(2, owner);
  find.bind_text(3, is_own ? access::kLocal : owner).bind_text(4, is_own ? "" : owner);
  if (!find.step()) return std::nullopt;
  if (find.bytes(1) == request_hash) return find.integer(0);
  throw ServiceError(ServiceError::Kind::already_exists,
                     "The request_id \"" + request_id + "\" was used for a different request, which created " +
                         collection + "/" + std::to_string(find.integer(0)) + ". Use a new request_id.");
}

void Journal::note_service_clock() {
  writes_.run([&] {
    Statement(database_, "UPDATE service_clock SET seconds = MAX(seconds, ?1)").bind(1, clock_.seconds()).run();
  });
}

void Journal::set_measured(const std::vector<Measured>& jobs) {
  if (jobs.empty()) return;
  writes_.run([&] {
    // What it shares with others counts in full.
    Statement update(database_, "UPDATE jobs SET measured = 1, bytes = ?2 + LENGTH(job) + LENGTH(submitted_case) + " +
                                    content_size_of("jobs") +
                                    " + COALESCE((SELECT SUM(LENGTH(payload)) FROM events WHERE job = ?1), 0) "
                                    "+ COALESCE((SELECT LENGTH(mesh) + " +
                                    content_size_of("meshes") +
                                    " FROM meshes WHERE job = ?1), 0) WHERE number = ?1 AND ended_at IS NOT NULL");
    for (const auto& [job, folder_bytes] : jobs) update.bind(1, job).bind(2, folder_bytes).run();
  });
}

void Journal::begin_sweep_deletion(std::int64_t sweep) {
  writes_.run([&] {
    const std::string name = sweep_name_of(sweep);
    {
      Statement read(database_, "SELECT 1 FROM sweeps WHERE number = ?1");
      if (!read.bind(1, sweep).step()) throw ServiceError(ServiceError::Kind::not_found, "There is no " + name + ".");
    }
    if (const std::string unended = unended_jobs(database_, sweep); !unended.empty()) {
      throw ServiceError(ServiceError::Kind::failed_precondition,
                         name + " cannot be deleted while some of its jobs have not ended: " + unended +
                             ". Cancel the sweep, then delete it once they have ended.");
    }
    Statement(database_, "UPDATE sweeps SET deleting = 1, request_id = NULL, request_hash = NULL WHERE number = ?1")
        .bind(1, sweep)
        .run();
  });
}

void Journal::end_sweep_deletion(std::int64_t sweep) {
  writes_.run([&] {
    Statement(database_,
              "DELETE FROM sweeps WHERE number = ?1 AND deleting = 1 "
              "AND NOT EXISTS (SELECT 1 FROM sweep_jobs WHERE sweep = ?1)")
        .bind(1, sweep)
        .run();
  });
}

}  // namespace cellcrush::store
