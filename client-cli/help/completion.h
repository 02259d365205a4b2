#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush::client {

/// Completion scripts for the commands and options of `app`; presets, choices and fields of the
/// case complete without a server, and other values as files.
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);
std::string fish_completion(const CLI::App& app);

}  // namespace cellcrush::client
