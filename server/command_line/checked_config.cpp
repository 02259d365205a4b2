#include "command_line/checked_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

namespace cellcrush {
namespace {

// Insertions, deletions and substitutions that make one word of the other.
std::size_t distance_of(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, substituted}));
    }
  }
  return row.back();
}

std::string nearest_option(const CLI::App& app, const std::string& key) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, key.size() / 3) + 1;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      const std::size_t distance = distance_of(key, name);
      if (distance >= least) continue;
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

// What the reader makes of the begin and the end of a table.
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
