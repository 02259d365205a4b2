#include "command_line/usage_message.h"

#include <fmt/format.h>

#include "command_line/nearest_option.h"

namespace cellcrush {
namespace {

// The command on the command line, or the program itself.
const CLI::App& parsed_command(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

}  // namespace

std::string usage_message(const CLI::App* app, const CLI::Error& error) {
  std::string message = error.what();
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    for (const std::string& word : app->remaining(true)) {
      if (!word.starts_with("--")) continue;
      const std::string name = word.substr(2, word.find('=') - 2);
      std::string nearest = nearest_option(parsed_command(*app), name);
      if (nearest.empty()) nearest = nearest_option(*app, name);
      message = fmt::format("--{} is not an option.", name);
      if (!nearest.empty()) message += fmt::format(" Did you mean \"--{}\"?", nearest);
      break;
    }
  }
  return fmt::format("cellcrushd: {}\n`cellcrushd --help` lists all options and commands.\n", message);
}

}  // namespace cellcrush
