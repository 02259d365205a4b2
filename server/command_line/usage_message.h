#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush {

/// The message for wrong usage: the parser's own, or for an unknown option its name and the nearest one.
std::string usage_message(const CLI::App* app, const CLI::Error& error);

}  // namespace cellcrush
