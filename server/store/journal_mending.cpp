#include "store/journal_mending.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/spdlog.h>

#include <vector>

#include "store/job_rows.h"
#include "store/job_state.h"
#include "store/journal_schema.h"
#include "store/queued_job.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

struct DamagedJob {
  std::int64_t number = 0;
  std::int64_t state = 0;
  std::int64_t last_sequence = 0;
  v1::Job job;
  bool has_job = false;
  bool has_case = false;
};

std::vector<DamagedJob> find_damaged(Database& database) {
  Statement read(database, "SELECT number, state, last_sequence, job, submitted_case FROM jobs ORDER BY number");
  std::vector<DamagedJob> out;
  while (read.step()) {
    DamagedJob row{read.integer(0), read.integer(1), read.integer(2), {}, false, false};
    const std::string submitted = read.bytes(4);
    row.has_job = read_job_bytes(read.bytes(3), row.state, row.job);
    row.has_case = !submitted.empty() && v1::Case().ParseFromString(submitted);
    if (!row.has_job || !row.has_case) out.push_back(std::move(row));
  }
  return out;
}

// The newest state event has the same bytes as the job.
bool restore_job(Database& database, DamagedJob& row) {
  Statement read(database, "SELECT payload FROM events WHERE job = ?1 ORDER BY sequence DESC LIMIT 1");
  return read.bind(1, row.number).step() && read_job_bytes(read.bytes(0), row.state, row.job);
}

void write_row(Database& database, const DamagedJob& row) {
  Statement update(database, "UPDATE jobs SET state = ?2, job = ?3 WHERE number = ?1");
  update.bind(1, row.number).bind(2, row.job.state()).bind_blob(3, job_bytes(row.job)).run();
}

void end_job(Database& database, DamagedJob& row, std::int64_t service_seconds) {
  const bool had_ended = is_terminal(static_cast<v1::Job::State>(row.state));
  set_corrupt(row.job);
  const auto now = google::protobuf::util::TimeUtil::GetCurrentTime();
  if (!row.job.has_create_time()) *row.job.mutable_create_time() = now;
  *row.job.mutable_end_time() = now;
  // No event follows that of a job's end.
  had_ended ? write_row(database, row) : add_state(database, row.number, row.job, row.last_sequence + 1);
  Statement update(database, "UPDATE jobs SET ended_at = COALESCE(ended_at, ?2) WHERE number = ?1");
  update.bind(1, row.number).bind(2, service_seconds).run();
}

void mend(Database& database, DamagedJob& row, std::int64_t service_seconds) {
  const std::string name = name_of(row.number);
  const bool had_ended = is_terminal(static_cast<v1::Job::State>(row.state));
  const bool restored = !row.has_job && restore_job(database, row);
  if (restored) {
    spdlog::warn("The journal entry of {} was damaged and has been rebuilt from its newest event.", name);
    write_row(database, row);
  }
  if (!row.has_case && (row.has_job || restored) && had_ended) {
    spdlog::error("The case of {} is damaged and cannot be read; the rest of the job is readable.", name);
    return;
  }
  if (restored && row.has_case) return;
  end_job(database, row, service_seconds);
  spdlog::error("{} is FAILED with STORE_CORRUPT: {}", name, row.job.cause_message());
}

}  // namespace

bool read_job_bytes(const std::string& bytes, std::int64_t state, v1::Job& job) {
  if (job.ParseFromString(bytes) && job.state() == state) {
    if (job.executor().empty()) job.set_executor(kLocalExecutor);
    return true;
  }
  job.Clear();
  return false;
}

ServiceError unreadable_entry(std::int64_t job) {
  return {ServiceError::Kind::data_loss,
          "The journal entry of " + name_of(job) + " cannot be read. Restart the daemon to repair it."};
}

void set_corrupt(v1::Job& job) {
  job.set_state(v1::Job::FAILED);
  job.set_cause(v1::Job::STORE_CORRUPT);
  job.set_cause_message("The job's records in the journal cannot be read: the file was damaged.");
  job.set_remedy("Check the disk for faults, then submit the case again.");
  job.clear_worker_pid();
}

void mend_jobs(Database& database, std::int64_t service_seconds) {
  auto damaged = find_damaged(database);
  if (damaged.empty()) return;
  Transaction transaction(database);
  for (auto& row : damaged) mend(database, row, service_seconds);
  transaction.commit();
}

}  // namespace cellcrush::store
