#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush {

/// The man page cellcrushd(8) in the macros of man(7), from the definition that the program parses with.
std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace cellcrush
