#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush::client {

/// Adds --time-limit to a command. `seconds` stays 0 without the option; `default_text` describes that default.
void add_time_limit_option(CLI::App& command, double& seconds, const std::string& default_text = "the daemon's limit");

}  // namespace cellcrush::client
