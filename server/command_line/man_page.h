#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush {

/// The man page cellcrushd(8) in man(7) macros, generated from the parser's own definition.
std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace cellcrush
