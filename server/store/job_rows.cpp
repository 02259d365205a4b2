#include "store/job_rows.h"

namespace cellcrush::store {

std::string job_bytes(v1::Job job) {
  job.clear_name();
  job.clear_case_();
  job.clear_progress();
  job.clear_place();
  return job.SerializeAsString();
}

void add_state(Database& database, std::int64_t number, const v1::Job& job, std::int64_t sequence) {
  const std::string bytes = job_bytes(job);
  Statement insert(database, "INSERT INTO events (job, sequence, payload) VALUES (?1, ?2, ?3)");
  insert.bind(1, number).bind(2, sequence).bind_blob(3, bytes).run();
  Statement update(database, "UPDATE jobs SET state = ?2, job = ?3, last_sequence = ?4 WHERE number = ?1");
  update.bind(1, number).bind(2, job.state()).bind_blob(3, bytes).bind(4, sequence).run();
}

void remove_rows(Database& database, std::int64_t job) {
  for (const char* sql : {"DELETE FROM events WHERE job = ?1", "DELETE FROM meshes WHERE job = ?1",
                          "DELETE FROM sweep_jobs WHERE job = ?1", "DELETE FROM job_labels WHERE job = ?1",
                          "DELETE FROM jobs WHERE number = ?1"})
    Statement(database, sql).bind(1, job).run();
}

}  // namespace cellcrush::store
