// How jobs come into the journal and leave it.
#include <utility>

#include "error.h"
#include "jobs/job_state.h"
#include "jobs/resource_name.h"
#include "store/job_inserter.h"
#include "store/journal.h"

namespace cellcrush::store {

Journal::Created Journal::create_job(v1::Job job, const std::string& request_id, const std::string& request_hash,
                                     std::int64_t element_steps, const Admit& admit) {
  Created created;
  writes_.run([&] {
    if (const auto before = find_request("jobs", request_id, request_hash)) {
      created = {*before, false};
    } else {
      if (admit) admit();
      created.job = JobInserter(database_).insert(std::move(job), {request_id, request_hash, {}, element_steps});
    }
  });
  if (created.is_new) on_durable_(created.job);
  return created;
}

void Journal::delete_job(std::int64_t job) {
  writes_.run([&] {
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
  });
  on_durable_(job);
}

void Journal::note_folder_removed(std::int64_t job) {
  writes_.run([&] { Statement(database_, "DELETE FROM deleted_jobs WHERE number = ?1").bind(1, job).run(); });
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

}  // namespace cellcrush::store
