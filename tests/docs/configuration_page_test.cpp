// server/configuration.md is made from the daemon's options. CELLCRUSH_WRITE_PAGES=1 writes it.
#include "docs/configuration_page.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "command_line/daemon_flags.h"

namespace cellcrush::docs {
namespace {

const std::filesystem::path kPage = std::filesystem::path(CELLCRUSH_SOURCE_ROOT) / "server/configuration.md";

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.") == std::string::npos;
}

TEST(ConfigurationPageTest, IsWhatTheOptionsOfTheDaemonMakeIt) {
  const std::string made = configuration_page();
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) std::ofstream(kPage, std::ios::binary) << made;
  EXPECT_EQ(text_of(kPage), made) << "An option or its help has changed. Write the page again: CELLCRUSH_WRITE_PAGES=1 "
                                     "build/ci/bin/docs_configuration_page";
}

TEST(ConfigurationPageTest, DefaultsInTheHelpAreThoseInForce) {
  CLI::App app("cellcrushd");
  const DaemonFlags flags(app);
  int compared = 0;
  for (CLI::Option* option : app.get_options()) {
    if (option->get_lnames().empty() || option->get_lnames().front() == "help") continue;
    const std::string in_help = default_in_help(*option);
    const std::string number = in_help.substr(0, in_help.find(','));
    option->capture_default_str();
    const std::string in_force = option->get_default_str();
    if (!is_number(number) || in_force.empty()) continue;
    EXPECT_DOUBLE_EQ(std::stod(number), std::stod(in_force)) << "--" << option->get_lnames().front();
    ++compared;
  }
  EXPECT_GE(compared, 12);
}

// Parses flags together with the page's example of a file.
void parse_with_example(CLI::App& app, const std::string& flags) {
  const auto path = std::filesystem::temp_directory_path() / ("configuration-example-" + std::to_string(getpid()));
  std::ofstream(path) << configuration_example();
  EXPECT_NO_THROW(app.parse(flags + "--config " + path.string()));
  std::filesystem::remove(path);
}

TEST(ConfigurationPageTest, ItsExampleIsAFileThatTheDaemonTakes) {
  CLI::App app("cellcrushd");
  const DaemonFlags flags(app);
  parse_with_example(app, "");
  const auto options = flags.options();
  EXPECT_EQ(options.data_folder, "/var/lib/cellcrush");
  EXPECT_EQ(options.listen.size(), 2U);
  EXPECT_EQ(options.workers, 4);
  EXPECT_EQ(flags.log_format(), "json");
}

TEST(ConfigurationPageTest, FlagsOverrideTheFile) {
  CLI::App app("cellcrushd");
  const DaemonFlags flags(app);
  parse_with_example(app, "--workers 2 --listen 127.0.0.1:0 ");
  EXPECT_EQ(flags.options().workers, 2);
  EXPECT_EQ(flags.options().listen, std::vector<std::string>{"127.0.0.1:0"});
}

}  // namespace
}  // namespace cellcrush::docs
