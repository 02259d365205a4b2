#pragma once

#include <string>

namespace cellcrush::client {

/// Whether a name from the command line is a sweep's: "sweeps/NAME".
bool names_sweep(const std::string& name);

/// A job's full name: "jobs/NAME" for a NAME without a slash. Throws CommandError (refused) for a sweep's name.
std::string job_name(const std::string& name);

/// A sweep's full name: "sweeps/NAME" for a NAME without a slash. Throws CommandError (refused) for a job's name.
std::string sweep_name(const std::string& name);

}  // namespace cellcrush::client
