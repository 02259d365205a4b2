// Every option says in --help what it is when it is not given; its unit and limits stand there too.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

// The entries of all groups of a help, such as "Options:", up to its examples, each in one line.
std::vector<std::string> entries_of(const std::string& help) {
  std::vector<std::string> out;
  std::istringstream lines(help);
  std::string line;
  while (std::getline(lines, line) && line != "Examples:") {
    if (!line.starts_with("  ")) continue;
    if (line[2] != ' ') {
      out.push_back(line);
    } else if (!out.empty()) {
      out.back() += line;
    }
  }
  return out;
}

bool is_option(const std::string& entry) { return entry[2] == '-'; }

std::string help_of(const std::vector<std::string>& words) {
  std::vector<std::string> command = words;
  command.emplace_back("--help");
  const Outcome outcome = run(command, kShortLimit);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  return outcome.output;
}

// Those with a value that need not be given.
void expect_defaults(const std::vector<std::string>& words, int& options) {
  for (const std::string& entry : entries_of(help_of(words))) {
    if (!is_option(entry)) continue;
    const bool takes_a_value = entry.find(" TEXT") != std::string::npos || entry.find(" INT") != std::string::npos ||
                               entry.find(" FLOAT") != std::string::npos || entry.find(" UINT") != std::string::npos ||
                               entry.find(" TIME") != std::string::npos;
    if (!takes_a_value || entry.find("REQUIRED") != std::string::npos) continue;
    ++options;
    EXPECT_NE(entry.find("default: "), std::string::npos) << words.back() << ": " << entry;
  }
}

TEST(Help, EveryOptionOfEveryCommandTellsItsDefault) {
  for (const char* program : {CELLCRUSH_PROGRAM, CELLCRUSHD_PROGRAM}) {
    int options = 0;
    expect_defaults({program}, options);
    int commands = 0;
    for (const std::string& entry : entries_of(help_of({program}))) {
      if (is_option(entry)) continue;
      ++commands;
      std::string command;
      std::istringstream(entry) >> command;
      expect_defaults({program, command}, options);
    }
    EXPECT_GT(commands, 3) << program;
    EXPECT_GT(options, 10) << program;
  }
}

TEST(Help, LimitsStandThere) {
  EXPECT_NE(help_of({CELLCRUSHD_PROGRAM}).find("--workers INT:INT in [1 - 1024]"), std::string::npos);
  EXPECT_NE(help_of({CELLCRUSH_PROGRAM, "submit"}).find("--priority INT:INT in [-100 - 100]"), std::string::npos);
}

using Completion = DaemonTest;

TEST_F(Completion, KnowsThePresetsOfTheServer) {
  const Outcome script = run({CELLCRUSH_PROGRAM, "completion", "fish"}, kShortLimit);
  std::istringstream lines(cellcrush({"presets"}).output);
  int presets = 0;
  for (std::string word; lines >> word;) {
    if (!word.starts_with("preset:")) continue;
    ++presets;
    EXPECT_NE(script.output.find(word), std::string::npos) << word;
  }
  const std::string of_check = script.output.substr(script.output.find("__fish_seen_subcommand_from check' -a '"));
  const std::string line = of_check.substr(0, of_check.find('\n'));
  int known = 0;
  for (std::size_t at = line.find("preset:"); at != std::string::npos; at = line.find("preset:", at + 1)) ++known;
  EXPECT_EQ(known, presets);
}

TEST(DaemonManPage, NamesEveryCommandAndEveryOption) {
  std::vector<std::string> words = {"backup", "verify", "restore", "token"};
  std::string help = help_of({CELLCRUSHD_PROGRAM});
  for (const std::string& command : words) {
    EXPECT_NE(help.find("\n  " + command + " "), std::string::npos) << help;
    help += help_of({CELLCRUSHD_PROGRAM, command});
  }
  const std::regex option("--[a-z][a-z-]*");
  for (std::sregex_iterator found(help.begin(), help.end(), option), end; found != end; ++found)
    words.push_back(found->str());
  EXPECT_GT(words.size(), 30U);
  const Outcome outcome = run({CELLCRUSHD_PROGRAM, "man"}, kShortLimit);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_TRUE(outcome.output.starts_with(".TH CELLCRUSHD 8 "));
  std::string page = outcome.output;
  for (const char* section : {".SH NAME\n", ".SH SYNOPSIS\n", ".SH OPTIONS\n", ".SH COMMANDS\n", ".SH SEE ALSO\n"})
    EXPECT_NE(page.find(section), std::string::npos) << section;
  page.erase(std::remove(page.begin(), page.end(), '\\'), page.end());
  for (const std::string& word : words) EXPECT_NE(page.find(word), std::string::npos) << word;
}

TEST(DaemonManPage, RoffHasNoWarnings) {
  if (run({"/bin/sh", "-c", "command -v man"}, kShortLimit).exit_code != 0) GTEST_SKIP() << "man is not installed";
  const std::string render = std::string(CELLCRUSHD_PROGRAM) + " man | man -l --warnings -E UTF-8 - 2>&1 > /dev/null";
  EXPECT_EQ(run({"/bin/sh", "-c", render}, kShortLimit).all(), "");
}

}  // namespace
}  // namespace cellcrush::e2e
