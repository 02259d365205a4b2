#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace cellcrush {

/// The candidate nearest to `word` by insertions, deletions, substitutions and transpositions, ignoring case; empty if
/// none is close enough.
std::string find_nearest(std::string_view word, const std::vector<std::string>& candidates);

/// A message followed by `did you mean "NEAREST"?`; unchanged if `nearest` is empty.
std::string with_suggestion(std::string message, const std::string& nearest);

/// The message for arguments that `app` could not parse: an unknown command or option with the nearest existing one,
/// else the parser's own, and where to find help.
std::string usage_message(const CLI::App& app, const CLI::Error& error);

}  // namespace cellcrush
