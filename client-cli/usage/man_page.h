#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush {

/// What a man page says that the parser does not know.
struct ManPage {
  int section = 1;
  std::string manual;    ///< "User Commands"
  std::string version;   ///< "1.0.0"
  std::string summary;   ///< what the program is for, behind its name
  std::string synopsis;  ///< its arguments
  std::string see_also;  ///< another page, "cellcrush (1)"
};

/// The man page of a program with all its commands, in the macros of man(7).
std::string man_page(const CLI::App& app, const ManPage& page);

}  // namespace cellcrush
