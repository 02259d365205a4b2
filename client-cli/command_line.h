#pragma once

#include "exit_code.h"

namespace cellcrush::client {

/// Runs the command that the arguments name; prints results on stdout and errors on stderr.
ExitCode run_command_line(int argc, char** argv);

}  // namespace cellcrush::client
