#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace cellcrush::docs {

/// server/configuration.md, made from the options of the daemon (DaemonFlags) and the prose around them
/// (configuration_prose.h). Throws std::logic_error for an option without a place in the page, or whose help does not
/// end with its default.
std::string configuration_page();

/// The default of an option in the words of its help: "256" of "... (default: 256)". Throws std::logic_error without
/// one.
std::string default_in_help(const CLI::Option& option);

/// The example of a file of --config that the page shows.
std::string configuration_example();

}  // namespace cellcrush::docs
