#include "usage_error.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "case_file/suggestion.h"
#include "help/command_entries.h"

namespace cellcrush::client {

namespace {

void append_option_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
}

std::string usage_message(const CLI::App& app, const CLI::App* command, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty()) return command == nullptr ? "no command given" : error.what();
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  if (word.starts_with('-')) {
    std::vector<std::string> names;
    if (command != nullptr) append_option_names(*command, names);
    append_option_names(app, names);
    return with_suggestion(fmt::format("unknown option \"{}\"", word), find_nearest(word, names));
  }
  if (command != nullptr) return fmt::format("unexpected argument \"{}\"", unknown.front());
  return with_suggestion(fmt::format("unknown command \"{}\"", word), find_nearest(word, command_names(app)));
}

}  // namespace

CommandError usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  const CLI::App* command = given.empty() ? nullptr : given.front();
  const std::string help =
      command == nullptr ? "cellcrush --help" : fmt::format("cellcrush {} --help", command->get_name());
  return {ExitCode::refused, fmt::format("{}\nSee `{}`.", usage_message(app, command, error), help)};
}

}  // namespace cellcrush::client
