#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace cellcrush {

/// An option as defined in the parser.
struct OptionEntry {
  std::vector<std::string> names;  ///< with dashes, such as "-o" and "--output"
  std::string value;               ///< placeholder of its value; empty for a flag
  std::string description;
  std::string group;   ///< heading under which the help lists it
  std::string limits;  ///< of its value, such as "-100 to 100"; empty: none beyond the description
  bool repeatable = false;
  bool required = false;
  std::vector<std::string> words;  ///< possible values; empty: any
};

/// A positional argument of a command.
struct ArgumentEntry {
  std::string name;  ///< such as "CASE" or "NAME...", in brackets if optional
  std::string description;
};

/// The commands listed in the help, without hidden ones.
std::vector<const CLI::App*> visible_commands(const CLI::App& app);
std::vector<std::string> command_names(const CLI::App& app);

/// The options of the program or of a command, including --help but no positional arguments.
std::vector<OptionEntry> option_entries(const CLI::App& app);

/// The positional arguments of a command, and their names alone.
std::vector<ArgumentEntry> argument_entries(const CLI::App& command);
std::vector<std::string> argument_names(const CLI::App& command);

}  // namespace cellcrush
