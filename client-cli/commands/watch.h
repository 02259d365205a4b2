#pragma once

#include <string>

#include "cellcrush/v1/job.pb.h"
#include "commands/commands.h"
#include "connection/interruption.h"

namespace cellcrush::client {

/// A job as a watch has left it.
struct WatchedJob {
  v1::Job job;
  bool complete = false;  ///< it has ended; otherwise the watch was interrupted
};

/// Shows a job on stdout to its end or to an interruption, and then how it ended. `time_limit_remedy` replaces the
/// server's for a job that took too long.
WatchedJob show_job_to_its_end(Session& session, const std::string& name, const Interruption& interruption,
                               const std::string& time_limit_remedy = {});

/// Watches a job to its end and prints how it ended. On Ctrl-C says that the job goes on.
ExitCode watch_job(Session& session, const std::string& name, const Interruption& interruption);

/// Watches a sweep until all its jobs have ended and prints its table and chart. On Ctrl-C says that the sweep goes on.
/// The code is `done` when all jobs succeeded, else `job_failed`.
ExitCode watch_sweep(Session& session, const std::string& name, const Interruption& interruption);

}  // namespace cellcrush::client
