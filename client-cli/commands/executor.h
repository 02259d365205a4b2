#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush::client {

/// Adds --executor to a command. `name` stays empty without the option.
void add_executor_option(CLI::App& command, std::string& name);

}  // namespace cellcrush::client
