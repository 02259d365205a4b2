#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>
#include <string_view>

#include "command_line/daemon_flags.h"
#include "usage/command_entries.h"

namespace cellcrush {
namespace {

constexpr std::size_t kColumns = 100;

// Lines of a comment.
std::string commented(const std::string& text) {
  std::istringstream words(text);
  std::string line = "#";
  std::string out;
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kColumns) {
      out += line + "\n";
      line = "#";
    }
    line += " " + word;
  }
  return out + line + "\n";
}

// The number in "... (default: 256)"; nothing if the default is no number.
std::string default_number(std::string_view description) {
  constexpr std::string_view kBefore = "(default: ";
  const auto at = description.rfind(kBefore);
  if (at == std::string_view::npos) return "";
  const std::string_view from = description.substr(at + kBefore.size());
  double value = 0.0;
  const auto [end, error] = std::from_chars(from.data(), from.data() + from.size(), value);
  const auto length = static_cast<std::size_t>(end - from.data());
  const bool is_number = error == std::errc() && (from[length] == ')' || from[length] == ',');
  return is_number ? std::string(from.substr(0, length)) : "";
}

// The default if it is a number or one of the words; otherwise what stands for a value.
std::string shown_value(const OptionEntry& option) {
  const std::string number = default_number(option.description);
  if (!number.empty()) return number;
  if (!option.limits.empty()) return "NUMBER";
  const auto word = std::ranges::find_if(
      option.words, [&](const std::string& each) { return option.description.ends_with("(default: " + each + ")"); });
  const std::string text = "\"" + (word == option.words.end() ? option.value : *word) + "\"";
  return option.repeatable ? "[" + text + "]" : text;
}

}  // namespace

std::string config_file(const CLI::App& app, const std::map<std::string, std::string>& given) {
  static const std::set<std::string> kOfCommandLine = {"help", "version", "config"};
  std::string out = commented("Options of " + app.get_name() + ", which reads this file when it starts. `" +
                              app.get_name() + " check-config --config FILE` checks it.");
  std::string group;
  for (const OptionEntry& option : option_entries(app)) {
    const std::string key = option.names.back().substr(2);
    if (kOfCommandLine.contains(key)) continue;
    if (option.group != group) out += fmt::format("\n### {}\n", option.group);
    group = option.group;
    const auto set = given.find(key);
    out += "\n" + commented(option.description);
    out += set != given.end() ? fmt::format("{} = {}\n", key, set->second)
                              : fmt::format("#{} = {}\n", key, shown_value(option));
  }
  return out;
}

}  // namespace cellcrush
