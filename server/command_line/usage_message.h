#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush {

/// What is printed for wrong usage: the parser's message, or for an unknown option its name and the nearest one.
std::string usage_message(const CLI::App* app, const CLI::Error& error);

}  // namespace cellcrush
