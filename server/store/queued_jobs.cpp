// The jobs that wait or run, with what the scheduler asks of them.
#include "store/journal_reader.h"

namespace cellcrush::store {

std::vector<QueuedJob> JournalReader::queued_jobs(v1::JobState state) {
  const std::scoped_lock lock(mutex_);
  Statement read(database_,
                 "SELECT jobs.number, COALESCE(jobs.submission, jobs.number), jobs.priority, jobs.element_steps, "
                 "sweeps.number, sweeps.max_parallel FROM jobs LEFT JOIN sweep_jobs ON sweep_jobs.job = jobs.number "
                 "LEFT JOIN sweeps ON sweeps.number = sweep_jobs.sweep WHERE jobs.state = ?1 ORDER BY jobs.number");
  read.bind(1, state);
  std::vector<QueuedJob> out;
  while (read.step()) {
    // Of a job without a sweep the last two are null and read as 0.
    out.push_back({read.integer(0), read.integer(1), static_cast<int>(read.integer(2)), read.integer(3),
                   read.integer(4), static_cast<int>(read.integer(5))});
  }
  return out;
}

}  // namespace cellcrush::store
