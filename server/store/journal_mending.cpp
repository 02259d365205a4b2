#include "store/journal_mending.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "clocks.h"
#include "store/contents.h"
#include "store/job_filter.h"
#include "store/job_rows.h"
#include "store/job_state.h"
#include "store/queued_job.h"
#include "store/resource_name.h"
#include "store/row_checksum.h"
#include "store/sample_reader.h"

namespace cellcrush::store {
namespace {

struct DamagedJob {
  std::int64_t number = 0;
  std::int64_t state = 0;
  v1::Job job;
  v1::Case submitted;
  bool has_job = false;
  bool has_case = false;
};

std::vector<DamagedJob> find_damaged(Database& database) {
  Statement read(database,
                 "SELECT number, state, job, submitted_case, checksum = expected_checksum AS is_whole, "
                 "case_checksum = row_checksum(submitted_case) AS has_case FROM jobs ORDER BY number");
  ContentReader contents(database);
  std::vector<DamagedJob> out;
  while (read.step()) {
    DamagedJob row{read.integer(0), read.integer(1), {}, {}, false, false};
    row.has_job = read.integer(4) != 0 && read_job_bytes(read.bytes(2), row.state, row.job);
    row.has_case = read.integer(5) != 0 && contents.read_case(read.bytes(3), row.submitted);
    if (!row.has_job || !row.has_case) out.push_back(std::move(row));
  }
  return out;
}

std::int64_t newest_event(Database& database, std::int64_t job) {
  return Statement(database, "SELECT MAX(sequence) FROM events WHERE job = ?1").bind(1, job).number();
}

// The newest state event has the same bytes as the job.
bool restore_job(Database& database, DamagedJob& row) {
  Statement read(database,
                 "SELECT payload FROM events WHERE job = ?1 AND sequence = ?2 AND checksum = expected_checksum");
  if (read.bind(1, row.number).bind(2, newest_event(database, row.number)).step() &&
      row.job.ParseFromString(read.bytes(0)) && row.job.state() != v1::Job::JOB_STATE_UNSPECIFIED)
    return true;
  row.job.Clear();
  return false;
}

// Samples in the reports of a job that has not ended: as many as the journal counted, or more.
std::int64_t count_reported(const std::filesystem::path& data_folder, std::int64_t job, std::int64_t begun_again) {
  try {
    const SampleRange all{job, begun_again, 0, std::numeric_limits<std::int64_t>::max()};
    return std::ssize(SampleReader(data_folder).read(all, {}).samples);
  } catch (const ServiceError&) {
    return 0;
  }
}

// Every column as the job and its events have it; what only the row knew is lost.
void rewrite_row(Database& database, const DamagedJob& row, const std::filesystem::path& data_folder,
                 std::int64_t service_seconds) {
  const bool has_ended = is_terminal(row.job.state());
  const std::int64_t begun_again = row.job.begun_again_sequence();
  const std::int64_t newest = newest_event(database, row.number);
  const std::int64_t states = Statement(database, "SELECT COUNT(*) FROM events WHERE job = ?1 AND sequence > ?2")
                                  .bind(1, row.number)
                                  .bind(2, begun_again)
                                  .number();
  // Of an ended job the last event is a state, so the numbers that no state has are those of samples.
  std::int64_t samples = 0;
  if (row.job.cause() != v1::Job::STORE_CORRUPT) {
    samples = has_ended ? newest - begun_again - states : count_reported(data_folder, row.number, begun_again);
  }
  Statement update(database,
                   "UPDATE jobs SET state = ?2, job = ?3, last_sequence = ?4, samples = ?5, begun_again = ?6, "
                   "states = (SELECT COUNT(*) FROM events WHERE job = ?1), priority = ?7, owner = ?8, title = ?9, "
                   "executor = ?10, ended_at = ?11, submission = NULL, element_steps = 0, measured = 0, "
                   "bytes = LENGTH(submitted_case) + 2 * LENGTH(?3) + " +
                       content_size_of("jobs") + " WHERE number = ?1");
  update.bind(1, row.number).bind(2, row.job.state()).bind_blob(3, job_bytes(row.job));
  update.bind(4, std::max(newest, begun_again + samples + states)).bind(5, samples).bind(6, begun_again);
  update.bind(7, row.job.priority()).bind_text(8, row.job.owner()).bind_text(9, folded_title(row.submitted.title()));
  update.bind_text(10, executor_column(row.job.executor()));
  has_ended ? update.bind(11, service_seconds) : update.bind_null(11);
  update.run();
  seal_job(database, row.number);
}

void end_job(Database& database, DamagedJob& row, const std::filesystem::path& data_folder,
             std::int64_t service_seconds) {
  const bool had_ended = is_terminal(static_cast<v1::Job::State>(row.state));
  const bool was_whole = row.has_job;
  set_corrupt(row.job);
  const auto now = google::protobuf::util::TimeUtil::GetCurrentTime();
  if (!row.job.has_create_time()) *row.job.mutable_create_time() = now;
  *row.job.mutable_end_time() = now;
  *row.job.mutable_state_time() = time_now();
  // No event follows that of a job's end.
  if (!had_ended) {
    Statement last(database,
                   "SELECT MAX(last_sequence * ?2, (SELECT COALESCE(MAX(sequence), 0) FROM events "
                   "WHERE job = ?1)) FROM jobs WHERE number = ?1");
    const std::int64_t next = last.bind(1, row.number).bind(2, was_whole ? 1 : 0).number() + 1;
    add_state(database, row.number, row.job, next);
  }
  if (!was_whole) return rewrite_row(database, row, data_folder, service_seconds);
  Statement update(database, "UPDATE jobs SET ended_at = COALESCE(ended_at, ?2) WHERE number = ?1");
  update.bind(1, row.number).bind(2, service_seconds).run();
}

void mend(Database& database, DamagedJob& row, const std::filesystem::path& data_folder, std::int64_t service_seconds) {
  const std::string name = name_of(row.number);
  if (!row.has_job && restore_job(database, row)) {
    spdlog::warn("The journal entry of {} was damaged and has been rebuilt from its newest event.", name);
    rewrite_row(database, row, data_folder, service_seconds);
    row.has_job = true;
    row.state = row.job.state();
    if (row.has_case) return;
  }
  if (row.has_job && is_terminal(row.job.state())) {
    spdlog::error("The case of {} is damaged and cannot be read; the rest of the job is readable.", name);
    return;
  }
  end_job(database, row, data_folder, service_seconds);
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
  return {
      ServiceError::Kind::data_loss,
      "The records of " + name_of(job) + " cannot be read: the journal was damaged. Restart the daemon to repair it."};
}

ServiceError unreadable_case(std::int64_t job) {
  return {ServiceError::Kind::data_loss,
          "The case of " + name_of(job) + " cannot be read: the journal was damaged. Restore a backup."};
}

ServiceError unreadable_sweep(std::int64_t sweep) {
  const std::string name = sweep_name_of(sweep);
  return {ServiceError::Kind::data_loss, name +
                                             " cannot be read: the journal was damaged. Restore a backup, or delete " +
                                             name + "; its jobs can be read by their own names."};
}

void set_corrupt(v1::Job& job) {
  job.set_state(v1::Job::FAILED);
  job.set_cause(v1::Job::STORE_CORRUPT);
  job.set_cause_message("The job's records in the journal cannot be read: the file was damaged.");
  job.set_remedy("Check the disk for faults, then submit the case again.");
  job.clear_worker_pid();
}

void mend_jobs(Database& database, const std::filesystem::path& data_folder, std::int64_t service_seconds) {
  auto damaged = find_damaged(database);
  const std::int64_t change =
      Statement(database, "SELECT MAX(number) FROM changes WHERE checksum <> expected_checksum").number();
  if (damaged.empty() && change == 0) return;
  Transaction transaction(database);
  // Whoever has seen fewer watches again from the beginning.
  Statement(database, "DELETE FROM changes WHERE number <= ?1").bind(1, change).run();
  for (auto& row : damaged) mend(database, row, data_folder, service_seconds);
  transaction.commit();
}

}  // namespace cellcrush::store
