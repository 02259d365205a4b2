// The jobs as the scheduler, retention and quotas see them. Those of a hidden sweep belong to an interrupted creation
// and do not run.
#include <string>

#include "store/journal_reader.h"

namespace cellcrush::store {
namespace {

constexpr const char* kSelectQueued =
    "SELECT jobs.number, COALESCE(jobs.submission, jobs.number), jobs.priority, jobs.element_steps, sweeps.number, "
    "sweeps.max_parallel, jobs.owner, jobs.executor FROM jobs LEFT JOIN sweep_jobs ON sweep_jobs.job = jobs.number "
    "LEFT JOIN sweeps ON sweeps.number = sweep_jobs.sweep WHERE jobs.state = ?1 AND sweeps.deleting IS NOT 1 ";

std::string executor_in(const std::string& column) { return column.empty() ? kLocalExecutor : column; }

// Without a sweep its columns are null and read as 0.
QueuedJob read_queued(const Statement& row) {
  return {row.integer(0), row.integer(1),           static_cast<int>(row.integer(2)),
          row.integer(3), row.integer(4),           static_cast<int>(row.integer(5)),
          row.bytes(6),   executor_in(row.bytes(7))};
}

}  // namespace

std::vector<QueuedJob> JournalReader::queued_jobs(v1::Job::State state, const std::optional<std::string>& executor) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 kSelectQueued + std::string(executor ? "AND jobs.executor = ?2 " : "") + "ORDER BY jobs.number");
  read.bind(1, state);
  if (executor) read.bind_text(2, executor_column(*executor));
  std::vector<QueuedJob> out;
  while (read.step()) out.push_back(read_queued(read));
  return out;
}

std::optional<QueuedJob> JournalReader::queued_job(std::int64_t job, v1::Job::State state) {
  const MutexLock lock(mutex_);
  Statement read(database_, kSelectQueued + std::string("AND jobs.number = ?2"));
  if (!read.bind(1, state).bind(2, job).step()) return std::nullopt;
  return read_queued(read);
}

std::optional<std::string> JournalReader::executor_of(std::int64_t job) {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT executor FROM jobs WHERE number = ?1");
  if (!read.bind(1, job).step()) return std::nullopt;
  return executor_in(read.bytes(0));
}

std::vector<std::string> JournalReader::executors_in_use() {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT DISTINCT executor FROM jobs WHERE state IN (?1, ?2, ?3, ?4) ORDER BY executor");
  read.bind(1, v1::Job::PENDING).bind(2, v1::Job::RUNNING).bind(3, v1::Job::SUSPENDED).bind(4, v1::Job::CANCELLING);
  std::vector<std::string> out;
  while (read.step()) out.push_back(executor_in(read.bytes(0)));
  return out;
}

EndedTotals JournalReader::ended_totals() {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT COUNT(*), COALESCE(SUM(bytes), 0) FROM jobs WHERE ended_at IS NOT NULL");
  read.step();
  return {read.integer(0), read.integer(1)};
}

std::vector<EndedJob> JournalReader::ended_jobs(const EndedJob& after, int limit) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 "SELECT jobs.number, jobs.ended_at, jobs.bytes, sweep_jobs.sweep FROM jobs "
                 "LEFT JOIN sweep_jobs ON sweep_jobs.job = jobs.number "
                 "WHERE jobs.ended_at IS NOT NULL AND (jobs.ended_at, jobs.number) > (?1, ?2) "
                 "AND jobs.checksum = jobs.expected_checksum "
                 "ORDER BY jobs.ended_at, jobs.number LIMIT ?3");
  read.bind(1, after.ended_at).bind(2, after.job).bind(3, limit);
  std::vector<EndedJob> out;
  // Without a sweep the last column is null and reads as 0.
  while (read.step()) out.push_back({read.integer(0), read.integer(1), read.integer(2), read.integer(3)});
  return out;
}

std::vector<std::int64_t> JournalReader::jobs_to_measure(int limit) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 "SELECT number FROM jobs WHERE measured = 0 AND ended_at IS NOT NULL ORDER BY number LIMIT ?1");
  return read.bind(1, limit).numbers();
}

std::int64_t JournalReader::bytes_of_owner(const std::string& owner) {
  const MutexLock lock(mutex_);
  return Statement(database_, "SELECT COALESCE(SUM(bytes), 0) FROM jobs WHERE owner = ?1").bind_text(1, owner).number();
}

std::map<std::string, std::int64_t> JournalReader::bytes_by_owner() {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT owner, SUM(bytes) FROM jobs GROUP BY owner");
  std::map<std::string, std::int64_t> out;
  while (read.step()) out[read.bytes(0)] = read.integer(1);
  return out;
}

}  // namespace cellcrush::store
