#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush::client {

/// Completion scripts for the commands and options of `app`. Presets, choices and case fields complete without a
/// server; other values complete as files.
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);
std::string fish_completion(const CLI::App& app);

/// The reference of all commands, client-cli/commands.md, in Markdown. Lines have at most 120 columns.
std::string command_page(const CLI::App& app);

}  // namespace cellcrush::client
