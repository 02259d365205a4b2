#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "store/queued_job.h"

namespace cellcrush::jobs {

/// The jobs that wait for a slot, and how many run of each sweep that limits that. Not thread-safe. Those of the highest
/// priority come first, of these the oldest submission, and of jobs that were submitted together those that are predicted to
/// take longest, in the order of their numbers where that is equal.
class WaitingJobs {
 public:
  /// Jobs of one submission have one priority and one sweep.
  void add(const store::QueuedJob& job);

  [[nodiscard]] std::size_t count() const { return count_; }

  /// Nothing happens when it does not wait.
  void remove(std::int64_t job);

  /// Whether the job's sweep runs as many jobs as it may.
  [[nodiscard]] bool is_held_back(const store::QueuedJob& job) const;

  /// The first job whose sweep lets it run, which counts as running from now on. Nothing when there is none.
  std::optional<store::QueuedJob> take();

  /// Counts a job as running that was not taken here.
  void count_running(const store::QueuedJob& job);

  /// A job that was taken, or counted, runs no more.
  void give_back(const store::QueuedJob& job);

 private:
  using Rank = std::pair<std::int64_t, std::int64_t>;   // what comes first has the lower one
  using Submission = std::map<Rank, store::QueuedJob>;  // by element_steps, job

  std::map<Rank, Submission> waiting_;   ///< by priority, submission
  std::map<std::int64_t, int> running_;  ///< by sweep; only of sweeps with a limit
  std::size_t count_ = 0;
};

}  // namespace cellcrush::jobs
