#pragma once

#include <CLI/App.hpp>

namespace cellcrush::client {

/// Adds --priority to a command.
void add_priority_option(CLI::App& command, int& priority);

}  // namespace cellcrush::client
