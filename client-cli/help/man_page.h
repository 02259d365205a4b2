#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush::client {

/// The man page of the program with all its commands, in the macros of man(7).
std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace cellcrush::client
