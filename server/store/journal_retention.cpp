// Retention of ended jobs: the service clock, their sizes, and the deletion of sweeps.
#include <string>

#include "error.h"
#include "store/job_state.h"
#include "store/journal.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

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

void Journal::note_service_clock() {
  writes_.run([&] {
    Statement(database_, "UPDATE service_clock SET seconds = MAX(seconds, ?1)").bind(1, clock_.seconds()).run();
  });
}

void Journal::set_measured(const std::vector<Measured>& jobs) {
  if (jobs.empty()) return;
  writes_.run([&] {
    Statement update(database_,
                     "UPDATE jobs SET measured = 1, bytes = ?2 + LENGTH(job) + LENGTH(submitted_case) "
                     "+ COALESCE((SELECT SUM(LENGTH(payload)) FROM events WHERE job = ?1), 0) "
                     "+ COALESCE((SELECT LENGTH(mesh) FROM meshes WHERE job = ?1), 0) "
                     "WHERE number = ?1 AND ended_at IS NOT NULL");
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
