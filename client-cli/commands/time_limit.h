#pragma once

#include <CLI/App.hpp>

namespace cellcrush::client {

/// Adds --time-limit to a command; `seconds` stays 0 without it.
void add_time_limit_option(CLI::App& command, double& seconds);

}  // namespace cellcrush::client
