#include "command_line/checked_config.h"

#include <fmt/format.h>

#include <string>

#include "command_line/nearest_option.h"

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
    const std::string nearest = nearest_option(app_, key);
    const std::string remedy =
        nearest.empty() ? "cellcrushd --help lists all options." : fmt::format("Did you mean \"{}\"?", nearest);
    throw CLI::ConfigError(fmt::format("the --config file sets \"{}\", which is not an option. {}", key, remedy),
                           CLI::ExitCodes::ConfigError);
  }
  return found;
}

}  // namespace cellcrush
