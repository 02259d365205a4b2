// client-cli/commands.md is what the program says of itself. CELLCRUSH_WRITE_PAGES=1 in the environment writes the
// page.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "program.h"

namespace cellcrush::client::testing {
namespace {

const std::filesystem::path kPage = std::filesystem::path(CELLCRUSH_SOURCE_ROOT) / "client-cli" / "commands.md";

std::string generated_page() {
  const ProgramResult result = run_program({"man", "--markdown"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return result.output;
}

TEST(CommandsPage, IsWhatTheProgramGenerates) {
  const std::string page = generated_page();
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) std::ofstream(kPage, std::ios::binary) << page;
  EXPECT_TRUE(read_file(kPage) == page) << kPage << " is out of date: run this test with CELLCRUSH_WRITE_PAGES=1";
}

TEST(CommandsPage, LinesEndWithin120Columns) {
  std::istringstream lines(generated_page());
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120U) << line;
}

TEST(CommandsPage, HasASectionForEachCommandOfTheHelp) {
  const std::string page = generated_page();
  std::istringstream lines(run_program({"--help"}).output);
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ") || line[2] < 'a' || line[2] > 'z') continue;
    ++commands;
    const std::string name = line.substr(2, line.find(' ', 2) - 2);
    const std::string heading = "\n### " + name + "\n";
    EXPECT_NE(page.find(heading), std::string::npos) << name;
    EXPECT_EQ(page.find(heading), page.rfind(heading)) << name << " stands twice";
  }
  EXPECT_GE(commands, 17);
}

}  // namespace
}  // namespace cellcrush::client::testing
