#pragma once

#include <vector>

#include "cellcrush/v1/admin_service.pb.h"
#include "store/queued_job.h"

namespace cellcrush::jobs {

/// A job that has a worker, and the seconds it has left.
struct RunningJob {
  store::QueuedJob job;
  double seconds_left = 0.0;
};

/// What is known of the workers.
struct WorkerFacts {
  int count = 1;
  double step_cost = 0.0;  ///< seconds of one core for a step of an element
  bool held = false;       ///< whether no job runs, as the disk is nearly full
};

/// Jobs that a queue names, at most.
inline constexpr int kMostEntries = 1000;

/// When each waiting job starts and why it does not now, found by playing the scheduler's rule (WaitingJobs) with predicted
/// times.
v1::Queue forecast_queue(const std::vector<RunningJob>& running, const std::vector<store::QueuedJob>& waiting,
                         const WorkerFacts& workers);

}  // namespace cellcrush::jobs
