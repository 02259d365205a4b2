#include "store/sweep_reader.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "cellcrush/v1/job.pb.h"
#include "store/contents.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"

namespace cellcrush::store {

SweepReader::SweepReader(const std::filesystem::path& path) : database_(path) {}

std::optional<v1::Sweep> SweepReader::find_sweep(std::int64_t sweep, Jobs jobs) {
  const MutexLock lock(mutex_);
  v1::Sweep out;
  Statement read(database_,
                 "SELECT sweep, checksum = expected_checksum FROM sweeps WHERE number = ?1 AND deleting = 0");
  if (!read.bind(1, sweep).step()) return std::nullopt;
  bool is_whole = read.integer(1) != 0 && ContentReader(database_).read_sweep(read.bytes(0), out);
  Statement members(
      database_,
      "SELECT jobs.number, CASE WHEN jobs.checksum = jobs.expected_checksum THEN jobs.state ELSE ?2 END, "
      "sweep_jobs.checksum = sweep_jobs.expected_checksum FROM sweep_jobs JOIN jobs ON jobs.number = sweep_jobs.job "
      "WHERE sweep_jobs.sweep = ?1 ORDER BY sweep_jobs.position");
  members.bind(1, sweep).bind(2, v1::Job::FAILED);
  auto& counts = *out.mutable_state_counts();
  while (jobs == Jobs::listed && members.step()) {
    is_whole = is_whole && members.integer(2) != 0;
    out.add_jobs(name_of(members.integer(0)));
    ++counts[v1::Job::State_Name(static_cast<v1::Job::State>(members.integer(1)))];
  }
  if (!is_whole) {
    spdlog::error("{}", unreadable_sweep(sweep).what());
    out.Clear();
  }
  out.set_name(sweep_name_of(sweep));
  return out;
}

std::vector<std::int64_t> SweepReader::list_sweeps(std::int64_t before, int limit) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 "SELECT number FROM sweeps WHERE number < ?1 AND deleting = 0 ORDER BY number DESC LIMIT ?2");
  return read.bind(1, before).bind(2, limit).numbers();
}

SweepEnd SweepReader::end_of(std::int64_t sweep) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 "SELECT COUNT(*), COALESCE(SUM(jobs.bytes), 0), MAX(jobs.ended_at), COUNT(jobs.ended_at) "
                 "FROM sweep_jobs JOIN jobs ON jobs.number = sweep_jobs.job WHERE sweep_jobs.sweep = ?1");
  read.bind(1, sweep).step();
  return {{read.integer(0), read.integer(1)}, read.integer(2), read.integer(0) == read.integer(3)};
}

std::optional<std::int64_t> SweepReader::find_unended(std::int64_t sweep) {
  const MutexLock lock(mutex_);
  // Those that end last tend to stand last.
  Statement read(database_,
                 "SELECT sweep_jobs.job FROM sweep_jobs JOIN jobs ON jobs.number = sweep_jobs.job "
                 "WHERE sweep = ?1 AND ended_at IS NULL ORDER BY position DESC LIMIT 1");
  return read.bind(1, sweep).step() ? std::optional(read.integer(0)) : std::nullopt;
}

std::int64_t SweepReader::newest_job(std::int64_t sweep) {
  const MutexLock lock(mutex_);
  return Statement(database_, "SELECT COALESCE(MAX(job), 0) FROM sweep_jobs WHERE sweep = ?1").bind(1, sweep).number();
}

std::vector<std::int64_t> SweepReader::sweeps_in_deletion() {
  const MutexLock lock(mutex_);
  return Statement(database_, "SELECT number FROM sweeps WHERE deleting = 1 ORDER BY number").numbers();
}

std::vector<std::int64_t> SweepReader::jobs_of(std::int64_t sweep) {
  const MutexLock lock(mutex_);
  return Statement(database_, "SELECT job FROM sweep_jobs WHERE sweep = ?1 ORDER BY position").bind(1, sweep).numbers();
}

StoredRows SweepReader::rows(std::int64_t sweep, std::int64_t after, PageRoom room) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 "SELECT sweep_jobs.point, jobs.number, jobs.job, jobs.state, sweep_jobs.position + 1, "
                 "jobs.checksum = jobs.expected_checksum, sweep_jobs.checksum = sweep_jobs.expected_checksum "
                 "FROM sweep_jobs JOIN jobs ON jobs.number = sweep_jobs.job "
                 "WHERE sweep_jobs.sweep = ?1 AND sweep_jobs.position >= ?2 ORDER BY sweep_jobs.position");
  read.bind(1, sweep).bind(2, after);
  StoredRows out;
  while (read.step()) {
    v1::SweepTable::Row row;
    if (read.integer(6) == 0 || !row.ParseFromString(read.bytes(0))) throw unreadable_sweep(sweep);
    row.set_job(name_of(read.integer(1)));
    if (read.integer(5) == 0 || !read_job_bytes(read.bytes(2), read.integer(3), *row.mutable_result()))
      set_corrupt(*row.mutable_result());
    row.mutable_result()->set_name(row.job());
    row.mutable_result()->clear_labels();
    out.has_more = !room.take(row.ByteSizeLong());
    if (out.has_more) break;
    out.rows.push_back(std::move(row));
    out.last_point = read.integer(4);
  }
  return out;
}

}  // namespace cellcrush::store
