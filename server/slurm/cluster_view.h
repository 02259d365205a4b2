#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "mutex.h"
#include "slurm/commands.h"

namespace cellcrush::slurm {

/// Begin of the names of all Slurm jobs of cellcrush.
inline constexpr const char* kJobPrefix = "cellcrush-";

/// What Slurm says of the jobs in a cluster, for all that follow them: one squeue at regular times, and sacct for jobs
/// that somebody misses. A job that squeue no longer lists keeps the last state seen. Thread-safe.
class ClusterView {
 public:
  /// `commands` outlives it. The first squeue runs at once.
  ClusterView(const Commands& commands, std::chrono::milliseconds interval);

  /// A task as Slurm last showed it.
  struct Seen {
    TaskReport report;
    std::uint64_t answer = 0;  ///< number of the answer that listed it last
    std::uint64_t heard = 0;   ///< number of the answer at which anything was last heard of it
  };
  /// The task of a job with this name: a controller that lost its state counts from 1 again.
  [[nodiscard]] std::optional<Seen> find(std::int64_t job, int task, const std::string& name);

  /// The job of this name.
  [[nodiscard]] std::optional<std::int64_t> find_job(const std::string& name);

  /// Number of answers of squeue so far. An answer counts from when it was asked for: one with a number beyond that of
  /// a moment shows what was there at that moment.
  [[nodiscard]] std::uint64_t answer_count();

  /// Why the last squeue failed; empty if it did not.
  [[nodiscard]] std::string trouble();

  /// Asks squeue soon, at most every two seconds, and sacct for this job unless it is 0.
  void refresh(std::int64_t missed_job = 0);

 private:
  void run(const std::stop_token& stop);
  void look(const std::set<std::int64_t>& missed);

  const Commands& commands_;
  std::chrono::milliseconds interval_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  std::map<std::pair<std::int64_t, int>, Seen> tasks_ CELLCRUSH_GUARDED_BY(mutex_);
  std::uint64_t answers_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  std::string trouble_ CELLCRUSH_GUARDED_BY(mutex_);
  bool is_wanted_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::set<std::int64_t> missed_ CELLCRUSH_GUARDED_BY(mutex_);
  std::jthread thread_;
};

}  // namespace cellcrush::slurm
