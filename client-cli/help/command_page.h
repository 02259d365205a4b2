#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush::client {

/// The reference of all commands, client-cli/commands.md, in Markdown. Lines have at most 120 columns.
std::string command_page(const CLI::App& app);

}  // namespace cellcrush::client
