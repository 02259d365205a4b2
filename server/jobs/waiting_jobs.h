#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "store/queued_job.h"

namespace cellcrush::jobs {

/// The jobs that wait for a slot, and what runs of each sweep and owner. Not thread-safe. Jobs of the highest priority
/// come first. Of these the next one belongs to the owner whose jobs hold the fewest cores, and of equal owners to the
/// oldest submission; of an owner's jobs the oldest submission comes first. Of jobs that were submitted together those
/// that are predicted to take longest come first, in the order of their numbers where that is equal.
class WaitingJobs {
 public:
  /// `owner_max_running`: jobs of one owner that run at once; 0: any number.
  explicit WaitingJobs(int owner_max_running = 0) : owner_max_running_(owner_max_running) {}

  /// Jobs of one submission have one priority, one sweep and one owner.
  void add(const store::QueuedJob& job);

  [[nodiscard]] std::size_t count() const { return places_.size(); }

  /// Jobs of that owner that wait.
  [[nodiscard]] std::size_t count_of(const std::string& owner) const;

  /// Nothing happens when it does not wait.
  void remove(std::int64_t job);

  /// Why a job may not run now though a core is free.
  enum class Limit { none, sweep, owner };
  [[nodiscard]] Limit limit_of(const store::QueuedJob& job) const;

  /// The first job that may run, which counts as running on one core from now on. Nothing when there is none.
  std::optional<store::QueuedJob> take();

  /// Counts a job as running that was not taken here.
  void count_running(const store::QueuedJob& job, int cores = 1);

  /// A job that runs holds so many cores more.
  void add_cores(const store::QueuedJob& job, int more) { running_of_owner_[job.owner].cores += more; }

  /// A job that was taken, or counted, runs no more.
  void give_back(const store::QueuedJob& job, int cores = 1);

 private:
  using Rank = std::pair<std::int64_t, std::int64_t>;      // what comes first has the lower one
  using Submission = std::map<Rank, store::QueuedJob>;     // by element_steps, job
  using Submissions = std::map<std::int64_t, Submission>;  // of one owner, the oldest first
  using OfPriority = std::map<std::string, Submissions>;   // by owner
  struct Place {
    std::int64_t priority = 0;  ///< negative: the highest comes first
    std::string owner;
    std::int64_t submission = 0;
    Rank rank;
  };
  struct Running {
    int jobs = 0;
    int cores = 0;
  };

  static Place place_of(const store::QueuedJob& job);
  /// The owners in the order in which their jobs come next.
  [[nodiscard]] std::vector<const OfPriority::value_type*> in_turn(const OfPriority& owners) const;
  [[nodiscard]] bool is_at_limit(const std::string& owner) const;
  [[nodiscard]] bool is_at_limit(std::int64_t sweep, int max_parallel) const;
  /// The owner's first job whose sweep lets it run.
  [[nodiscard]] const store::QueuedJob* first_of(const Submissions& submissions) const;

  int owner_max_running_;
  std::map<std::int64_t, OfPriority> waiting_;    ///< by negative priority
  std::map<std::int64_t, Place> places_;          ///< of the jobs in waiting_, by job
  std::map<std::string, std::size_t> of_owner_;   ///< how many wait
  std::map<std::int64_t, int> running_of_sweep_;  ///< only of sweeps with a limit
  std::map<std::string, Running> running_of_owner_;
};

}  // namespace cellcrush::jobs
