#pragma once

#include <functional>
#include <string>

namespace cellcrush::client {

/// Asks `question`; returns whether the user answers "y" or "yes". Asks on stderr if stdin and stderr are terminals.
/// Otherwise, as in a script, it returns true without asking.
bool confirm(const std::function<std::string()>& question);

}  // namespace cellcrush::client
