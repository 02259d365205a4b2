#include "command_line/checked_config.h"

#include <fmt/format.h>

#include <string>

#include "usage/command_entries.h"
#include "usage/suggestion.h"

namespace cellcrush {
namespace {

// How the reader represents the start and end of a table.
bool is_mark(const CLI::ConfigItem& item) { return item.name == "++" || item.name == "--"; }

}  // namespace

std::vector<CLI::ConfigItem> CheckedConfig::from_config(std::istream& input) const {
  auto found = CLI::ConfigTOML::from_config(input);
  for (const auto& item : found) {
    const std::string key = item.fullname();
    if (is_mark(item) || (item.parents.empty() && app_.get_option_no_throw("--" + key) != nullptr)) continue;
    std::vector<std::string> names;
    for (const OptionEntry& option : option_entries(app_)) names.push_back(option.names.back().substr(2));
    const std::string nearest = find_nearest(key, names);
    const std::string remedy =
        nearest.empty() ? "cellcrushd --help lists all options." : fmt::format("Did you mean \"{}\"?", nearest);
    throw CLI::ConfigError(fmt::format("the --config file sets \"{}\", which is not an option. {}", key, remedy),
                           CLI::ExitCodes::ConfigError);
  }
  return found;
}

}  // namespace cellcrush
