// The waiting and running jobs, with what the scheduler needs.
#include <string>

#include "store/journal_reader.h"

namespace cellcrush::store {
namespace {

constexpr const char* kSelectQueued =
    "SELECT jobs.number, COALESCE(jobs.submission, jobs.number), jobs.priority, jobs.element_steps, sweeps.number, "
    "sweeps.max_parallel, jobs.owner FROM jobs LEFT JOIN sweep_jobs ON sweep_jobs.job = jobs.number "
    "LEFT JOIN sweeps ON sweeps.number = sweep_jobs.sweep WHERE jobs.state = ?1 ";

// Without a sweep the last two columns are null and read as 0.
QueuedJob read_queued(const Statement& row) {
  return {row.integer(0), row.integer(1), static_cast<int>(row.integer(2)),
          row.integer(3), row.integer(4), static_cast<int>(row.integer(5)),
          row.bytes(6)};
}

}  // namespace

std::vector<QueuedJob> JournalReader::queued_jobs(v1::Job::State state) {
  const MutexLock lock(mutex_);
  Statement read(database_, kSelectQueued + std::string("ORDER BY jobs.number"));
  read.bind(1, state);
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

}  // namespace cellcrush::store
