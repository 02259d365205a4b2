#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace cellcrush::testing {

/// The processes whose parent is this one.
std::vector<pid_t> children_of(pid_t process);

/// The processes below this one, at any depth.
std::vector<pid_t> descendants_of(pid_t process);

/// Name of the program, at most 15 characters; empty when the process is gone.
std::string program_of(pid_t process);

}  // namespace cellcrush::testing
