#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace cellcrush::client {

/// An option as the parser has it.
struct OptionEntry {
  std::vector<std::string> names;  ///< with dashes, such as "-o" and "--output"
  std::string value;               ///< what its value is called; empty for a flag
  std::string description;
  std::string group;   ///< heading under which the help lists it
  std::string limits;  ///< of its value, such as "-100 to 100"; empty: none but those of the description
  bool repeatable = false;
  bool required = false;
  std::vector<std::string> words;  ///< that its value may be, or begins with where they end in "="; empty: a file
};

/// A positional argument of a command.
struct ArgumentEntry {
  std::string name;  ///< such as "CASE" or "NAME...", in brackets where it may be left out
  std::string description;
};

/// What the arguments of a command may be.
struct ArgumentWords {
  std::vector<std::string> words;  ///< whole, or beginnings where they end in "/"
  bool files = false;              ///< or a file
};

/// The commands that the help lists; hidden ones are left out.
std::vector<const CLI::App*> visible_commands(const CLI::App& app);
std::vector<std::string> command_names(const CLI::App& app);

/// The options of the program or of a command, --help included, arguments left out.
std::vector<OptionEntry> option_entries(const CLI::App& app);

/// The positional arguments of a command, and their names alone.
std::vector<ArgumentEntry> argument_entries(const CLI::App& command);
std::vector<std::string> argument_names(const CLI::App& command);

/// What stands for them, as far as it is known without a server: presets, beginnings of names, fields of the case.
ArgumentWords argument_words(const CLI::App& command);

}  // namespace cellcrush::client
