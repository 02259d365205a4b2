#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cellcrush/v1/admin_service.pb.h"
#include "store/queued_job.h"

namespace cellcrush::jobs {

/// A running job: its remaining seconds and its cores.
struct RunningJob {
  store::QueuedJob job;
  double seconds_left = 0.0;
  int cores = 1;
};

/// Facts about a job beyond its place in the queue.
struct JobFacts {
  int threads = 1;  ///< that it requests
  /// Share of it that previous workers have done, by its samples: of runs of few steps up to twice the true one.
  double done = 0.0;
};
using FactsOf = std::function<JobFacts(std::int64_t job)>;

/// State of the workers of one executor.
struct WorkerFacts {
  int count = 1;
  double step_cost = 0.0;     ///< seconds of one core for an element-step of the reference crush
  std::string held{};         ///< why the queue is held; empty if it is not
  int owner_max_running = 0;  ///< jobs of one owner that run at once; 0: no limit
  std::string executor = store::kLocalExecutor;

  /// Whether the workers are cores of this machine, which its jobs share.
  [[nodiscard]] bool are_cores() const { return executor == store::kLocalExecutor; }
};

/// Maximum number of jobs that a queue lists.
inline constexpr int kMostEntries = 1000;

/// Seconds of one core for an element-step of the reference crush (scene/run_cost.h of core), measured by a short run:
/// about 0.1 s. For predictions only: other work on the machine makes it vary.
double measure_step_cost();

/// Remaining seconds of a job on this many cores.
double predicted_seconds(const store::QueuedJob& job, const JobFacts& facts, int cores, double step_cost);

/// Cores that a starting job gets beside its first, of those free then; `waiting` other jobs have precedence.
int extra_cores(int threads, int free, std::size_t waiting);

/// Start time of each job that waits for one executor, and why it does not start now. Simulates the scheduler's rule
/// (WaitingJobs, extra_cores) with predicted times. Calls `facts_of` for each job listed.
v1::Queue forecast_queue(const std::vector<RunningJob>& running, const std::vector<store::QueuedJob>& waiting,
                         const WorkerFacts& workers, const FactsOf& facts_of);

}  // namespace cellcrush::jobs
