#pragma once

#include <string>

namespace cellcrush::client {

/// Whether a name given on the command line is that of a sweep: "sweeps/NAME".
bool names_sweep(const std::string& name);

/// A job's name as the server knows it: "jobs/NAME" for a NAME without a slash. Throws CommandError (refused) for the
/// name of a sweep.
std::string job_name(const std::string& name);

/// A sweep's name likewise: "sweeps/NAME" for a NAME without a slash. Throws CommandError (refused) for the name of a
/// job.
std::string sweep_name(const std::string& name);

}  // namespace cellcrush::client
