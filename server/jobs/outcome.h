#pragma once

#include <exception>

#include "jobs/executor.h"
#include "store/journal.h"

namespace cellcrush::jobs {

/// Whether the worker was lost by no fault of the case: it ended without a word, or could not be started. The job may then be
/// tried again.
bool is_lost(const WorkerExit& exit);

/// Whether the worker ended the job: its final report counts for more than the way the process ended.
bool is_last_word(const WorkerExit& exit);

/// The job's next state, from how its worker ended.
store::StateChange outcome_of(const WorkerExit& exit);

/// The job's last state when the daemon's own part of the run failed.
store::StateChange outcome_of(const std::exception& error);

/// The state of a job whose worker was ended, or went with the daemon, after the job was cancelled.
store::StateChange cancelled_without_result();

/// The last state of a job whose worker is not there any more; for tried_again.
store::StateChange worker_missing();

/// In place of the last state of a job that is lost: it waits for another worker.
store::StateChange tried_again(store::StateChange lost);

}  // namespace cellcrush::jobs
