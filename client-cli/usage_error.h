#pragma once

#include <CLI/App.hpp>

#include "command_error.h"

namespace cellcrush::client {

/// The error for arguments that `app` could not parse: an unknown command or option with the nearest existing one, else
/// the parser's message, and where to find help.
CommandError usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace cellcrush::client
