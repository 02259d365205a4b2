#include "help/command_entries.h"

namespace cellcrush::client {

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
    // Limits stand behind the type, as in "INT:POSITIVE".
    entry.value = entry.value.substr(0, entry.value.find(':'));
    entry.description = option->get_description();
    entry.repeatable = option->get_expected_max() > 1;
  }
  return entries;
}

std::vector<std::string> argument_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options([](const CLI::Option* o) { return o->get_positional(); })) {
    const std::string name = option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
    names.push_back(option->get_required() ? name : "[" + name + "]");
  }
  return names;
}

}  // namespace cellcrush::client
