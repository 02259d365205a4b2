// The options in server/configuration.md are those of the daemon. Its prose is written in the page; defaults, limits
// and what an option means come from DaemonFlags. CELLCRUSH_WRITE_PAGES=1 writes them into the page.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "chart/display_text.h"
#include "command_line/daemon_flags.h"
#include "usage/command_entries.h"

namespace cellcrush {
namespace {

const std::filesystem::path kPage = std::filesystem::path(CELLCRUSH_SOURCE_ROOT) / "server/configuration.md";

std::string page_text() {
  std::ifstream file(kPage, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// An option of the daemon, as the page shows it.
struct Described {
  std::string meaning;
  std::string default_value;  ///< in the words of the help, "256" of "... (default: 256)"
  std::string limits;         ///< "1 to 1024", or the words of a choice; empty without
};

// "1 to 10000000" of "1 to 1e+07".
std::string plain_numbers(const std::string& text) {
  std::istringstream words(text);
  std::string out;
  for (std::string word; words >> word;) {
    if (std::isdigit(static_cast<unsigned char>(word.front())) != 0) word = fmt::format("{}", std::stod(word));
    out += (out.empty() ? "" : " ") + word;
  }
  return out;
}

Described describe(const OptionEntry& option) {
  static const std::regex kHelp(R"((.*?)[ .]*\(default: (.*)\))");
  std::smatch help;
  EXPECT_TRUE(std::regex_match(option.description, help, kHelp))
      << option.names.back() << " tells no default at its end";
  Described out{help[1].str() + ".", help[2].str(), plain_numbers(option.limits)};
  // "unix:PATH" stays as it is.
  if (out.meaning.substr(0, out.meaning.find(' ')).find(':') == std::string::npos)
    out.meaning.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(out.meaning.front())));
  if (!option.words.empty()) out.limits = fmt::format("`{}`", fmt::join(option.words, "`, `"));
  return out;
}

std::map<std::string, Described> daemon_options() {
  CLI::App app("cellcrushd");
  const DaemonFlags flags(app);
  std::map<std::string, Described> out;
  for (const OptionEntry& option : option_entries(app)) {
    if (option.names.back() != "--help") out[option.names.back().substr(2)] = describe(option);
  }
  return out;
}

// The page with the rows and the first paragraphs of its options as they are now. Each option has both, once.
std::string with_options(const std::string& page) {
  static const std::regex kRow(R"(\| \[`([a-z-]+)`\]\(#[a-z-]+\) \| .* \| (.*) \| .* \|)");
  static const std::regex kValue(R"(`--[a-z-]+ ([^`]+)`:)");
  const std::map<std::string, Described> options = daemon_options();
  std::map<std::string, int> seen;
  std::istringstream lines(page);
  std::string out;
  std::string described;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (line.starts_with("#### ")) described = line.substr(5);
    if (std::regex_match(line, match, kRow) && options.contains(match[1].str())) {
      const Described& option = options.at(match[1].str());
      ++seen[match[1].str()];
      line = fmt::format("| [`{0}`](#{0}) | {1} | {2} | {3} |", match[1].str(), option.default_value, match[2].str(),
                         option.limits);
    } else if (line.starts_with("`--" + described + " ") && std::regex_search(line, match, kValue)) {
      ++seen[described];
      const std::string value = match[1].str();
      while (!line.empty() && std::getline(lines, line)) {
      }
      if (options.contains(described)) {
        out += client::wrapped(fmt::format("`--{} {}`: {}", described, value, options.at(described).meaning), 120);
      }
    }
    out += line + '\n';
  }
  for (const auto& [name, option] : options) EXPECT_EQ(seen[name], 2) << "--" << name << " has no place in the page";
  for (const auto& [name, count] : seen) EXPECT_TRUE(options.contains(name)) << "--" << name << " is no option";
  return out;
}

TEST(ConfigurationPageTest, IsWhatTheOptionsOfTheDaemonMakeIt) {
  const std::string page = page_text();
  const std::string made = with_options(page);
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) std::ofstream(kPage, std::ios::binary) << made;
  EXPECT_EQ(page_text(), made) << "An option or its help has changed. Write the page again: CELLCRUSH_WRITE_PAGES=1 "
                                  "build/ci/bin/docs_configuration_page";
}

TEST(ConfigurationPageTest, DefaultsInTheHelpAreThoseInForce) {
  CLI::App app("cellcrushd");
  const DaemonFlags flags(app);
  int compared = 0;
  for (const auto& [name, described] : daemon_options()) {
    const std::string number = described.default_value.substr(0, described.default_value.find(','));
    CLI::Option* option = app.get_option("--" + name);
    option->capture_default_str();
    const std::string in_force = option->get_default_str();
    if (number.find_first_not_of("0123456789.") != std::string::npos || in_force.empty()) continue;
    EXPECT_DOUBLE_EQ(std::stod(number), std::stod(in_force)) << "--" << name;
    ++compared;
  }
  EXPECT_GE(compared, 12);
}

TEST(ConfigurationPageTest, ItsExampleIsAFileThatTheDaemonTakesAndFlagsOverride) {
  const std::string page = page_text();
  const std::size_t begin = page.find("```toml\n") + 8;
  const auto path = std::filesystem::temp_directory_path() / ("configuration-example-" + std::to_string(getpid()));
  std::ofstream(path) << page.substr(begin, page.find("```", begin) - begin);
  const auto parse = [&](CLI::App& app, const std::string& flags) {
    EXPECT_NO_THROW(app.parse(flags + "--config " + path.string()));
  };
  CLI::App app("cellcrushd");
  const DaemonFlags flags(app);
  parse(app, "");
  EXPECT_EQ(flags.options().data_folder, "/var/lib/cellcrush");
  EXPECT_EQ(flags.options().listen.size(), 2U);
  EXPECT_EQ(flags.options().workers, 4);
  EXPECT_EQ(flags.log_format(), "json");
  CLI::App other("cellcrushd");
  const DaemonFlags overridden(other);
  parse(other, "--workers 2 --listen 127.0.0.1:0 ");
  EXPECT_EQ(overridden.options().workers, 2);
  EXPECT_EQ(overridden.options().listen, std::vector<std::string>{"127.0.0.1:0"});
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace cellcrush
