#pragma once

#include <cstdint>

#include "load/daemon_costs.h"

namespace cellcrush::load {

/// Jobs that are queued together, and the slots that run them.
struct Workload {
  int jobs = 1;
  int slots = 1;
  double run_s = 1.0;             ///< solver time of a job, mean
  double run_spread = 0.0;        ///< standard deviation relative to the mean; the times are log-normal
  double samples = 100.0;         ///< of a job, evenly over its run
  int watchers = 0;               ///< of all jobs
  double shared_cores = 0.0;      ///< cores that workers and daemon share; 0: the workers run on other machines
  double daemon_cores = 1.0;      ///< that the daemon can use for starting and ending jobs at once
  double start_interval_s = 0.0;  ///< of a batch system between two starts; 0: none
  std::uint64_t seed = 1;
};

/// Small jobs in slots of the machine that was measured, beside the daemon.
Workload small_jobs(int jobs, int slots, double cores, const DaemonCosts& costs);

/// What became of them.
struct Outcome {
  double makespan_s = 0.0;
  double jobs_per_s = 0.0;
  double busy_share = 0.0;  ///< of the slots' time in which a solver ran
  double daemon_cpu_s = 0.0;
  double daemon_cores =
      0.0;  ///< mean number of processors that the daemon wants; more than it has: events lag without bound
  double journal_share = 0.0;     ///< of the time in which the journal's turn was taken
  double events_per_s = 0.0;      ///< states and samples
  double change_latency_s = 0.0;  ///< of a change of state, from its request until it is durable; mean
  double longest_latency_s = 0.0;
  double journal_bytes = 0.0;
  double result_bytes = 0.0;
};

/// Simulates the queue by events: a slot takes a job, the daemon starts its worker, the change to RUNNING waits for the
/// journal's turn, the job runs, and its end is written likewise. All writes that wait share the next commit
/// (store/group_commit.h). Samples are committed once a second. Deterministic for a seed. REQUIRES: positive jobs,
/// slots and run_s.
Outcome simulate(const Workload& workload, const DaemonCosts& costs);

}  // namespace cellcrush::load
