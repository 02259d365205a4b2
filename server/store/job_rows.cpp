#include "store/job_rows.h"

#include <google/protobuf/util/time_util.h>

#include <memory>
#include <utility>

#include "clocks.h"
#include "store/job_filter.h"
#include "store/queued_job.h"

namespace cellcrush::store {

std::string job_bytes(v1::Job job) {
  job.clear_name();
  job.clear_case_();
  job.clear_progress();
  job.clear_place();
  return job.SerializeAsString();
}

void add_state(Database& database, std::int64_t number, const v1::Job& job, std::int64_t sequence,
               std::optional<std::int64_t> ended_at) {
  const std::string bytes = job_bytes(job);
  Statement insert(database, "INSERT OR REPLACE INTO events (job, sequence, payload) VALUES (?1, ?2, ?3)");
  insert.bind(1, number).bind(2, sequence).bind_blob(3, bytes).run();
  Statement update(database,
                   "UPDATE jobs SET state = ?2, job = ?3, last_sequence = ?4, states = states + (last_sequence < ?4), "
                   "ended_at = COALESCE(?5, ended_at) WHERE number = ?1");
  update.bind(1, number).bind(2, job.state()).bind_blob(3, bytes).bind(4, sequence);
  ended_at ? update.bind(5, *ended_at) : update.bind_null(5);
  update.run();
}

void insert_mesh(Database& database, std::int64_t job, const v1::Mesh& mesh) {
  // Deleted first, which a replacement is not to the trigger that forgets contents.
  Statement(database, "DELETE FROM meshes WHERE job = ?1").bind(1, job).run();
  Statement insert(database, "INSERT INTO meshes (job, mesh) VALUES (?1, ?2)");
  insert.bind(1, job).bind_blob(2, ContentWriter(database).of_mesh(mesh)).run();
}

bool has_job(Database& database, std::int64_t job) {
  return Statement(database, "SELECT 1 FROM jobs WHERE number = ?1").bind(1, job).step();
}

void remove_rows(Database& database, std::int64_t job) {
  for (const char* sql : {"DELETE FROM events WHERE job = ?1", "DELETE FROM meshes WHERE job = ?1",
                          "DELETE FROM sweep_jobs WHERE job = ?1", "DELETE FROM job_labels WHERE job = ?1",
                          "DELETE FROM jobs WHERE number = ?1"})
    Statement(database, sql).bind(1, job).run();
}

JobInserter::JobInserter(Database& database)
    : database_(database),
      contents_(database),
      job_(database,
           "INSERT INTO jobs (state, job, submitted_case, request_id, request_hash, last_sequence, priority, "
           "submission, element_steps, owner, title, bytes, executor, case_checksum) "
           "VALUES (?1, ?2, ?3, ?4, ?5, 1, ?6, ?7, ?8, ?9, ?10, ?11, ?12, row_checksum(?3))"),
      event_(database, "INSERT INTO events (job, sequence, payload) VALUES (?1, 1, ?2)"),
      label_(database, "INSERT INTO job_labels (key, value, job) VALUES (?1, ?2, ?3)") {}

std::int64_t JobInserter::insert(v1::Job job, const JobEntry& entry) {
  job.set_state(v1::Job::PENDING);
  if (job.executor().empty()) job.set_executor(kLocalExecutor);
  *job.mutable_create_time() = google::protobuf::util::TimeUtil::GetCurrentTime();
  *job.mutable_state_time() = time_now();
  // Taken out, so that the bytes are made without it.
  const std::unique_ptr<v1::Case> submitted(job.release_case_());
  if (submitted) job.set_title(submitted->title());
  const std::string bytes = job_bytes(job);
  const std::string title = submitted ? folded_title(submitted->title()) : "";
  const std::size_t case_size = submitted ? submitted->ByteSizeLong() : 0;
  const std::string case_bytes = submitted ? contents_.of_case(std::move(*submitted)) : "";
  job_.bind(1, v1::Job::PENDING).bind_blob(2, bytes).bind_blob(3, case_bytes);
  if (entry.request_id.empty()) {
    job_.bind_null(4).bind_null(5);
  } else {
    job_.bind_text(4, entry.request_id).bind_text(5, entry.request_hash);
  }
  job_.bind(6, job.priority()).bind(8, entry.element_steps).bind_text(9, job.owner());
  job_.bind_text(10, title).bind(11, static_cast<std::int64_t>(case_size + 2 * bytes.size()));
  job_.bind_text(12, executor_column(job.executor()));
  entry.submission ? job_.bind(7, *entry.submission) : job_.bind_null(7);
  job_.run();
  const std::int64_t number = database_.last_number();
  event_.bind(1, number).bind_blob(2, bytes).run();
  for (const auto& [key, value] : job.labels()) label_.bind_text(1, key).bind_text(2, value).bind(3, number).run();
  return number;
}

}  // namespace cellcrush::store
