#include "docs/configuration_page.h"

#include <cctype>
#include <iomanip>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "chart/display_text.h"
#include "command_line/daemon_flags.h"
#include "docs/configuration_prose.h"

namespace cellcrush::docs {
namespace {

constexpr int kColumns = 120;
constexpr std::string_view kDefault = "(default: ";

// The text of help before its default.
std::string meaning_of(const CLI::Option& option) {
  const std::string& help = option.get_description();
  std::string out = help.substr(0, help.rfind(kDefault));
  while (!out.empty() && (out.back() == ' ' || out.back() == '.')) out.pop_back();
  const std::string first_word = out.substr(0, out.find(' '));
  // "unix:PATH" stays as it is.
  if (first_word.find(':') == std::string::npos)
    out.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(out.front())));
  return out + ".";
}

// "1000000000" of "1e+09".
std::string plain_number(const std::string& text) {
  if (text.find('e') == std::string::npos) return text;
  std::ostringstream out;
  out << std::fixed << std::setprecision(0) << std::stod(text);
  return out.str();
}

// "1 to 1024" of "INT:INT in [1 - 1024]"; the words of a choice; empty without a limit.
std::string limits_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto colon = type.find(':');
  if (colon == std::string::npos) return "";
  std::string check = type.substr(colon + 1);
  if (const auto open = check.find('['); open != std::string::npos) {
    const auto dash = check.find(" - ", open);
    const auto close = check.find(']', open);
    if (dash == std::string::npos || close == std::string::npos) return check;
    return plain_number(check.substr(open + 1, dash - open - 1)) + " to " +
           plain_number(check.substr(dash + 3, close - dash - 3));
  }
  if (!check.starts_with('{')) return check;
  std::string out;
  for (const char character : check.substr(1, check.size() - 2))
    out += character == ',' ? std::string("`, `") : std::string(1, character);
  return "`" + out + "`";
}

std::string option_table(const std::vector<const CLI::Option*>& options,
                         const std::map<std::string, OptionProse>& prose) {
  std::string out = "| Key | Default | Unit | Limits |\n|---|---|---|---|\n";
  for (const CLI::Option* option : options) {
    const std::string& name = option->get_lnames().front();
    out.append("| [`").append(name).append("`](#").append(name).append(") | ").append(default_in_help(*option));
    out.append(" | ").append(prose.at(name).unit).append(" | ").append(limits_of(*option)).append(" |\n");
  }
  return out;
}

std::string option_text(const CLI::Option& option, const OptionProse& prose) {
  const std::string& name = option.get_lnames().front();
  std::string out = "#### " + name + "\n\n";
  out += client::wrapped("`--" + name + " " + prose.value + "`: " + meaning_of(option), kColumns);
  for (const auto& paragraph : prose.paragraphs) out += "\n" + client::wrapped(paragraph, kColumns);
  return out + "\n";
}

std::map<std::string, const CLI::Option*> options_of(const CLI::App& app) {
  std::map<std::string, const CLI::Option*> out;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_lnames().empty() || option->get_lnames().front() == "help") continue;
    out[option->get_lnames().front()] = option;
  }
  return out;
}

std::string group_text(const OptionGroup& group, std::map<std::string, const CLI::Option*>& left) {
  std::vector<const CLI::Option*> options;
  std::map<std::string, OptionProse> prose;
  for (const auto& [name, words] : group.options) {
    const auto found = left.find(name);
    if (found == left.end()) throw std::logic_error("The page describes --" + name + ", which is no option.");
    options.push_back(found->second);
    prose[name] = words;
    left.erase(found);
  }
  std::string out = "### " + group.title + "\n\n";
  if (!group.introduction.empty()) out += client::wrapped(group.introduction, kColumns) + "\n";
  out += option_table(options, prose) + "\n";
  for (const CLI::Option* option : options) out += option_text(*option, prose.at(option->get_lnames().front()));
  return out;
}

}  // namespace

std::string default_in_help(const CLI::Option& option) {
  const std::string& help = option.get_description();
  const auto begin = help.rfind(kDefault);
  const auto end = help.rfind(')');
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::logic_error("The help of --" + option.get_lnames().front() + " does not end with \"(default: ...)\".");
  return help.substr(begin + kDefault.size(), end - begin - kDefault.size());
}

std::string configuration_example() { return kExample; }

std::string configuration_page() {
  CLI::App app("cellcrushd");
  const DaemonFlags flags(app);
  auto left = options_of(app);
  std::string out = std::string(kHead) + "```toml\n" + kExample + "```\n\n" + kBehindExample;
  for (const auto& group : option_groups()) out += group_text(group, left);
  if (!left.empty()) {
    throw std::logic_error("--" + left.begin()->first +
                           " has no place in the page. Give it one in tests/docs/configuration_prose.cpp.");
  }
  return out + kTail;
}

}  // namespace cellcrush::docs
