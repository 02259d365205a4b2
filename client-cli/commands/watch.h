#pragma once

#include <string>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sweep.pb.h"
#include "commands/commands.h"
#include "connection/streams.h"

namespace cellcrush::client {

/// A job as last seen by a watch.
struct WatchedJob {
  v1::Job job;
  bool complete = false;  ///< it has ended; otherwise the watch was interrupted
};

/// Shows a job on stdout until it ends or the user interrupts, then its outcome. `time_limit_remedy` replaces the
/// server's remedy for a job that exceeded its time limit.
WatchedJob show_job_to_its_end(Session& session, const std::string& name, const Interruption& interruption,
                               const std::string& time_limit_remedy = {});

/// Watches a job until it ends and prints the outcome. On Ctrl-C prints that the job keeps running.
ExitCode watch_job(Session& session, const std::string& name, const Interruption& interruption);

/// A sweep as last seen by a watch.
struct WatchedSweep {
  v1::Sweep sweep;
  bool complete = false;       ///< all its jobs have ended; otherwise the watch was interrupted
  bool all_succeeded = false;  ///< only if complete
};

/// Shows a sweep on stdout until all its jobs have ended. On Ctrl-C prints that the sweep keeps running.
WatchedSweep show_sweep_to_its_end(Session& session, const std::string& name, const Interruption& interruption);

/// Watches a sweep until all its jobs have ended, then prints its table and chart. On Ctrl-C prints that the sweep
/// keeps running. Returns `done` if all jobs succeeded, else `job_failed`.
ExitCode watch_sweep(Session& session, const std::string& name, const Interruption& interruption);

}  // namespace cellcrush::client
