#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cellcrush/v1/admin_service.pb.h"
#include "store/queued_job.h"

namespace cellcrush::jobs {

/// A job that has a worker, the seconds it has left, and the cores that it holds.
struct RunningJob {
  store::QueuedJob job;
  double seconds_left = 0.0;
  int cores = 1;
};

/// What is known of a job beside its place in the queue.
struct JobFacts {
  int threads = 1;                      ///< that it asks for
  std::int64_t element_steps_done = 0;  ///< by workers that left it
};
using FactsOf = std::function<JobFacts(std::int64_t job)>;

/// What is known of the workers.
struct WorkerFacts {
  int count = 1;
  double step_cost = 0.0;     ///< seconds of one core for a step of an element
  std::string held{};         ///< why no job starts; empty where nothing holds the queue
  int owner_max_running = 0;  ///< jobs of one owner that run at once; 0: any number
};

/// Jobs that a queue names, at most.
inline constexpr int kMostEntries = 1000;

/// Seconds that a job takes on so many cores, from where it was left.
double predicted_seconds(const store::QueuedJob& job, const JobFacts& facts, int cores, double step_cost);

/// Cores that a job gets beside its first one when it starts, of those that are then free; `waiting` others come first.
int extra_cores(int threads, int free, std::size_t waiting);

/// When each waiting job starts and why it does not now, found by playing the scheduler's rule (WaitingJobs,
/// extra_cores) with predicted times. `facts_of` is asked of each job that the queue names.
v1::Queue forecast_queue(const std::vector<RunningJob>& running, const std::vector<store::QueuedJob>& waiting,
                         const WorkerFacts& workers, const FactsOf& facts_of);

}  // namespace cellcrush::jobs
