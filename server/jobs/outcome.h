#pragma once

#include <exception>

#include "jobs/executor.h"
#include "shortage.h"
#include "store/journal.h"

namespace cellcrush::jobs {

/// Whether the worker was lost through no fault of the case: it ended without a report, met a shortage or could not be
/// started. The job may then be retried.
bool is_lost(const WorkerExit& exit);

/// The shortage that the worker met, or the daemon while starting it; none if the worker was lost for another reason.
/// The job is left at its last checkpoint.
Trouble trouble_of_exit(const WorkerExit& exit);

/// The job waits as before, until the shortage ends.
store::StateChange waits_for(const Trouble& trouble);

/// Whether a run ended because it needs more memory than it was allowed. It may be retried with more.
bool needs_more_memory(const worker::Final& final);

/// Whether the worker ended the job: its final report then overrides the exit status of the process.
bool is_last_word(const WorkerExit& exit);

/// The job's next state after its worker ended.
store::StateChange outcome_of(const WorkerExit& exit);

/// The job's last state if the daemon's own part of the run failed for a reason other than a shortage.
store::StateChange outcome_of(const std::exception& error);

/// The state of a cancelled job whose worker was killed or is gone.
store::StateChange cancelled_without_result();

/// The last state of a job whose worker is gone; input of tried_again.
store::StateChange worker_missing();

/// Replaces the last state of a lost job: it waits for another worker.
store::StateChange tried_again(store::StateChange lost);

}  // namespace cellcrush::jobs
