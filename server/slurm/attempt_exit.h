#pragma once

#include <optional>
#include <string>

#include "jobs/executor.h"
#include "slurm/attempt.pb.h"
#include "slurm/commands.h"

namespace cellcrush::slurm {

/// "Slurm job 17_3"; "Slurm job cellcrush-NAME" while its number is unknown.
std::string slurm_name(const Attempt& attempt);

/// How a task reports the exit of its worker.
Ended::Kind ended_kind(jobs::WorkerExit::Kind kind);

/// Whether the worker came to the end of the job. It may have been told to leave while it wrote the result.
bool ends_job(const Ended& ended);

/// The exit of an attempt that ended with this last word, on this host.
jobs::WorkerExit exit_of_last_word(const Ended& ended, const Attempt& attempt, const std::string& host);

/// The exit of an attempt that is over without a last word, by what Slurm says of its task. `what`: as a sentence.
jobs::WorkerExit exit_by_meaning(Meaning meaning, const std::optional<worker::Final>& final, const std::string& what);

}  // namespace cellcrush::slurm
