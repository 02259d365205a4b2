// What retention and quotas need to know of jobs.
#include "store/journal_reader.h"

namespace cellcrush::store {

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
  read.bind(1, limit);
  std::vector<std::int64_t> out;
  while (read.step()) out.push_back(read.integer(0));
  return out;
}

std::int64_t JournalReader::bytes_of_owner(const std::string& owner) {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT COALESCE(SUM(bytes), 0) FROM jobs WHERE owner = ?1");
  return read.bind_text(1, owner).step() ? read.integer(0) : 0;
}

}  // namespace cellcrush::store
