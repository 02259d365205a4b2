// How sweeps come into the journal, and what is done to several of their jobs at once.
#include <google/protobuf/util/time_util.h>

#include <utility>

#include "store/job_inserter.h"
#include "store/journal.h"

namespace cellcrush::store {
namespace {

// Sweeps keep what was asked for; their jobs and states are looked up.
std::string sweep_bytes(v1::Sweep sweep) {
  sweep.clear_name();
  sweep.clear_jobs();
  sweep.clear_state_counts();
  return sweep.SerializeAsString();
}

}  // namespace

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
    if (!request_id.empty()) insert.bind_text(3, request_id).bind_text(4, request_hash);
    insert.run();
    created.sweep = database_.last_number();
    JobInserter inserter(database_);
    Statement join(database_, "INSERT INTO sweep_jobs (sweep, position, job, point) VALUES (?1, ?2, ?3, ?4)");
    JobEntry entry;
    for (const auto& made : jobs) {
      v1::SweepTable::Row point;
      point.mutable_values()->Add(made.values.begin(), made.values.end());
      const auto position = static_cast<std::int64_t>(created.jobs.size());
      entry.element_steps = made.element_steps;
      created.jobs.push_back(inserter.insert(made.job, entry));
      entry.submission = created.jobs.front();
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

}  // namespace cellcrush::store
