#include "store/begin_again.h"

#include "error.h"
#include "store/job_bytes.h"
#include "store/journal_mending.h"
#include "store/journal_schema.h"
#include "store/resource_name.h"

namespace cellcrush::store {

void begin_again(Database& database, std::int64_t job, const std::string& why) {
  v1::Job stored;
  std::int64_t sequence = 0;
  {
    Statement read(database, "SELECT job, state, last_sequence FROM jobs WHERE number = ?1");
    if (!read.bind(1, job).step())
      throw ServiceError(ServiceError::Kind::not_found, "There is no " + name_of(job) + ".");
    if (!read_job_bytes(read.bytes(0), read.integer(1), stored)) throw unreadable_entry(job);
    sequence = read.integer(2) + 1;
  }
  if (stored.state() != v1::Job::PENDING && stored.state() != v1::Job::RUNNING &&
      stored.state() != v1::Job::SUSPENDED) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       name_of(job) + " is " + v1::Job::State_Name(stored.state()) + " and cannot be restarted.");
  }
  if (stored.state() == v1::Job::RUNNING) stored.set_state(v1::Job::PENDING);
  stored.set_cause_message(why);
  stored.set_worker_pid(0);
  stored.set_begun_again_sequence(sequence);
  Statement(database, "DELETE FROM events WHERE job = ?1 AND kind = ?2").bind(1, job).bind(2, kSampleEvent).run();
  Statement(database, "DELETE FROM meshes WHERE job = ?1").bind(1, job).run();
  Statement insert(database, "INSERT INTO events (job, sequence, kind, payload) VALUES (?1, ?2, ?3, ?4)");
  insert.bind(1, job).bind(2, sequence).bind(3, kStateEvent).bind_blob(4, job_bytes(stored)).run();
  Statement update(database, "UPDATE jobs SET state = ?2, job = ?3, last_sequence = ?4 WHERE number = ?1");
  update.bind(1, job).bind(2, stored.state()).bind_blob(3, job_bytes(stored)).bind(4, sequence).run();
}

}  // namespace cellcrush::store
