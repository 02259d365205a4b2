#include "usage/command_entries.h"

#include <regex>
#include <sstream>

namespace cellcrush {

namespace {

// Limits that the parser appends to a type: "POSITIVE", "INT in [-100 - 100]".
std::string limits_of(const std::string& type) {
  static const std::regex kRange(R"(in \[(.*) - (.*)\])");
  std::smatch range;
  if (std::regex_search(type, range, kRange)) return range[1].str() + " to " + range[2].str();
  return type.find("POSITIVE") == std::string::npos ? "" : "above 0";
}

// "x", "y" and "xy" of the type "TEXT:{x,y,xy}".
std::vector<std::string> choices_in(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t begin = type.find('{');
  if (begin == std::string::npos) return choices;
  std::istringstream parts(type.substr(begin + 1, type.find('}') - begin - 1));
  for (std::string choice; std::getline(parts, choice, ',');) choices.push_back(choice);
  return choices;
}

}  // namespace

std::vector<const CLI::App*> visible_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : visible_commands(app)) names.push_back(command->get_name());
  return names;
}

std::vector<OptionEntry> option_entries(const CLI::App& app) {
  std::vector<OptionEntry> entries;
  for (const CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->nonpositional(); })) {
    OptionEntry& entry = entries.emplace_back();
    for (const std::string& name : option->get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) entry.names.push_back("--" + name);
    if (option->get_type_size() != 0) entry.value = option->get_type_name();
    entry.words = choices_in(option->get_type_name());
    // Limits follow the type, as in "INT:POSITIVE".
    entry.limits = limits_of(entry.value);
    entry.value = entry.value.substr(0, entry.value.find(':'));
    entry.description = option->get_description();
    entry.group = option->get_group();
    entry.repeatable = option->get_expected_max() > 1;
    entry.required = option->get_required();
  }
  return entries;
}

std::vector<ArgumentEntry> argument_entries(const CLI::App& command) {
  std::vector<ArgumentEntry> entries;
  for (const CLI::Option* option : command.get_options([](const CLI::Option* o) { return o->get_positional(); })) {
    const std::string name = option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
    entries.push_back({option->get_required() ? name : "[" + name + "]", option->get_description()});
  }
  return entries;
}

std::vector<std::string> argument_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const ArgumentEntry& argument : argument_entries(command)) names.push_back(argument.name);
  return names;
}

}  // namespace cellcrush
