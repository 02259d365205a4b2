#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "metrics/metrics.h"
#include "store/queued_job.h"

namespace cellcrush::jobs {

/// Jobs that wait and run.
struct Load {
  double longest_wait_s = 0.0;  ///< so far, of a job that waits, since it joined the queue of this daemon
  std::map<std::string, metrics::Standing::Owner> owners{};
};

/// The queue of waiting jobs, with counts of running jobs by sweep and owner. Not thread-safe. The order is: highest
/// priority; then the owner whose running jobs hold the fewest cores; then the oldest submission. Jobs submitted
/// together start with the longest predicted run, then by number.
class WaitingJobs {
 public:
  /// `owner_max_running`: jobs of one owner that run at once; 0: no limit.
  explicit WaitingJobs(int owner_max_running = 0) : owner_max_running_(owner_max_running) {}

  /// Jobs of one submission share priority, sweep and owner.
  void add(const store::QueuedJob& job);

  [[nodiscard]] std::size_t count() const { return places_.size(); }

  void add_load(Load& to) const;

  /// Number of waiting jobs of this owner.
  [[nodiscard]] std::size_t count_of(const std::string& owner) const;

  /// No effect unless the job waits.
  void remove(std::int64_t job);

  /// Why a job may not run now though a core is free.
  enum class Limit { none, sweep, owner };
  [[nodiscard]] Limit limit_of(const store::QueuedJob& job) const;

  /// Removes and returns the first job that may run; it counts as running on one core from now on. Nothing if there is
  /// none.
  std::optional<store::QueuedJob> take();

  /// Counts a running job that was not taken here.
  void count_running(const store::QueuedJob& job, int cores = 1);

  /// Adds cores to a running job.
  void add_cores(const store::QueuedJob& job, int more) { running_of_owner_[job.owner].cores += more; }

  /// A taken or counted job has stopped running.
  void give_back(const store::QueuedJob& job, int cores = 1);

 private:
  using Rank = std::pair<std::int64_t, std::int64_t>;      // the lowest rank comes first
  using Submission = std::map<Rank, store::QueuedJob>;     // by element_steps, job
  using Submissions = std::map<std::int64_t, Submission>;  // of one owner, oldest first
  using OfPriority = std::map<std::string, Submissions>;   // by owner
  struct Place {
    std::int64_t priority = 0;  ///< negated: the highest comes first
    std::string owner;
    std::int64_t submission = 0;
    Rank rank;
    std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
  };
  struct Running {
    int jobs = 0;
    int cores = 0;
  };

  static Place place_of(const store::QueuedJob& job);
  /// The owners in the order of their next jobs.
  [[nodiscard]] std::vector<const OfPriority::value_type*> in_turn(const OfPriority& owners) const;
  [[nodiscard]] bool is_at_limit(const std::string& owner) const;
  [[nodiscard]] bool is_at_limit(std::int64_t sweep, int max_parallel) const;
  /// The owner's first job whose sweep may run another.
  [[nodiscard]] const store::QueuedJob* first_of(const Submissions& submissions) const;

  int owner_max_running_;
  std::map<std::int64_t, OfPriority> waiting_;    ///< by negated priority
  std::map<std::int64_t, Place> places_;          ///< of the jobs in waiting_, by job
  std::map<std::string, std::size_t> of_owner_;   ///< number of waiting jobs
  std::map<std::int64_t, int> running_of_sweep_;  ///< only for sweeps with a limit
  std::map<std::string, Running> running_of_owner_;
};

}  // namespace cellcrush::jobs
