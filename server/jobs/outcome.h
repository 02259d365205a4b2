#pragma once

#include <exception>

#include "jobs/executor.h"
#include "shortage.h"
#include "store/journal.h"

namespace cellcrush::jobs {

/// Whether the worker was lost by no fault of the case: it ended without a word, met a shortage or could not be
/// started. The job may then be tried again.
bool is_lost(const WorkerExit& exit);

/// What the worker, or the daemon that was to start it, lacked; none when it was lost for another reason. The worker
/// has left the job at its last checkpoint.
Trouble trouble_of_exit(const WorkerExit& exit);

/// The job waits as before, until what was short is there again.
store::StateChange waits_for(const Trouble& trouble);

/// Whether the worker ended the job: its final report counts for more than the way the process ended.
bool is_last_word(const WorkerExit& exit);

/// The job's next state, from how its worker ended.
store::StateChange outcome_of(const WorkerExit& exit);

/// The job's last state when the daemon's own part of the run failed, other than by a shortage.
store::StateChange outcome_of(const std::exception& error);

/// The state of a job whose worker was ended, or went with the daemon, after the job was cancelled.
store::StateChange cancelled_without_result();

/// The last state of a job whose worker is not there any more; for tried_again.
store::StateChange worker_missing();

/// In place of the last state of a job that is lost: it waits for another worker.
store::StateChange tried_again(store::StateChange lost);

}  // namespace cellcrush::jobs
