#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace cellcrush::e2e {

/// What `COMMAND... --help` prints; a failure fails the test.
std::string help_of(std::vector<std::string> command);

/// The entries of all groups of a help, such as "Options:", up to its examples, each in one line.
std::vector<std::string> help_entries(const std::string& help);

/// The options that a help shows, with their dashes: those at the start of an entry, and of a usage line.
std::set<std::string> options_of(const std::string& help);

/// What a program accepts, as its help shows it.
struct ProgramHelp {
  std::set<std::string> options;                          ///< of the program itself, with their dashes
  std::map<std::string, std::set<std::string>> commands;  ///< options of each command

  /// Whether the program or one of its commands has the option.
  [[nodiscard]] bool has(const std::string& option) const;
};

/// Asks a program for its help, and for that of each of its commands.
ProgramHelp read_help(const std::string& program);

}  // namespace cellcrush::e2e
