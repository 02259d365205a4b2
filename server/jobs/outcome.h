#pragma once

#include <exception>

#include "jobs/executor.h"
#include "store/journal.h"

namespace cellcrush::jobs {

/// The job's last state, from how its worker ended. A final report counts for more than the way the process ended.
store::StateChange outcome_of(const WorkerExit& exit);

/// The job's last state when the daemon's own part of the run failed.
store::StateChange outcome_of(const std::exception& error);

/// The state of a job whose worker was ended, or went with the daemon, after the job was cancelled.
store::StateChange cancelled_without_result();

/// The state of a job whose worker went with the daemon.
store::StateChange worker_lost();

}  // namespace cellcrush::jobs
