// Every option says in --help what it is when it is not given; its unit and limits stand there too.
#include <gtest/gtest.h>

#include <sstream>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

// The entries of a help's part, such as "Options:", each in one line.
std::vector<std::string> entries_of(const std::string& help, const std::string& part) {
  std::vector<std::string> out;
  std::istringstream lines(help.substr(std::min(help.size(), help.find("\n" + part + "\n"))));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  while (std::getline(lines, line) && !line.empty()) {
    const bool begins = line.size() > 2 && line[2] != ' ';
    if (begins) {
      out.push_back(line);
    } else if (!out.empty()) {
      out.back() += line;
    }
  }
  return out;
}

std::string help_of(const std::vector<std::string>& words) {
  std::vector<std::string> command = words;
  command.emplace_back("--help");
  const Outcome outcome = run(command, kShortLimit);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  return outcome.output;
}

// Those with a value that need not be given.
void expect_defaults(const std::vector<std::string>& words, int& options) {
  for (const std::string& entry : entries_of(help_of(words), "Options:")) {
    const bool takes_a_value = entry.find(" TEXT") != std::string::npos || entry.find(" INT") != std::string::npos ||
                               entry.find(" FLOAT") != std::string::npos || entry.find(" UINT") != std::string::npos;
    if (!takes_a_value || entry.find("REQUIRED") != std::string::npos) continue;
    ++options;
    EXPECT_NE(entry.find("default: "), std::string::npos) << words.back() << ": " << entry;
  }
}

TEST(Help, EveryOptionOfEveryCommandTellsItsDefault) {
  for (const char* program : {CELLCRUSH_PROGRAM, CELLCRUSHD_PROGRAM}) {
    int options = 0;
    expect_defaults({program}, options);
    const auto commands = entries_of(help_of({program}), "Subcommands:");
    EXPECT_FALSE(commands.empty());
    for (const std::string& entry : commands) {
      std::string command;
      std::istringstream(entry) >> command;
      expect_defaults({program, command}, options);
    }
    EXPECT_GT(options, 10) << program;
  }
}

TEST(Help, LimitsStandThere) {
  EXPECT_NE(help_of({CELLCRUSHD_PROGRAM}).find("--workers INT:INT in [1 - 1024]"), std::string::npos);
  EXPECT_NE(help_of({CELLCRUSH_PROGRAM, "submit"}).find("--priority INT:INT in [-100 - 100]"), std::string::npos);
}

}  // namespace
}  // namespace cellcrush::e2e
