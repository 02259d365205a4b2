// Every option says in --help what it is when it is not given; its unit and limits stand there too.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "e2e/daemon_test.h"
#include "programs/program_help.h"

namespace cellcrush::e2e {
namespace {

constexpr const char* kPrograms[] = {CELLCRUSH_PROGRAM, CELLCRUSHD_PROGRAM};

TEST(Help, EveryOptionOfEveryCommandTellsItsDefault) {
  static const std::regex kTakesAValue(" (TEXT|INT|FLOAT|UINT|TIME)");
  for (const char* program : kPrograms) {
    std::vector<std::string> helps = {help_of({program})};
    for (const auto& [command, known] : read_help(program).commands) helps.push_back(help_of({program, command}));
    int options = 0;
    for (const std::string& help : helps) {
      for (const std::string& entry : help_entries(help)) {
        // Those with a value that need not be given.
        const bool is_optional =
            entry[2] == '-' && std::regex_search(entry, kTakesAValue) && entry.find("REQUIRED") == std::string::npos;
        if (!is_optional) continue;
        ++options;
        EXPECT_NE(entry.find("default: "), std::string::npos) << entry;
      }
    }
    EXPECT_GT(helps.size(), 4U) << program;
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

TEST(ManPage, NamesEveryCommandAndEveryOption) {
  for (const char* program : kPrograms) {
    const ProgramHelp help = read_help(program);
    std::set<std::string> words = help.options;
    for (const auto& [command, options] : help.commands) {
      words.insert(command);
      words.insert(options.begin(), options.end());
    }
    EXPECT_GT(words.size(), 30U);
    const Outcome outcome = run({program, "man"}, kShortLimit);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    std::string page = outcome.output;
    EXPECT_TRUE(page.starts_with(".TH CELLCRUSH 1 ") || page.starts_with(".TH CELLCRUSHD 8 "));
    page.erase(std::remove(page.begin(), page.end(), '\\'), page.end());
    words.insert(
        {".SH NAME\n", ".SH SYNOPSIS\n", ".SH DESCRIPTION\n", ".SH OPTIONS\n", ".SH COMMANDS\n", ".SH SEE ALSO\n"});
    for (const std::string& word : words) EXPECT_NE(page.find(word), std::string::npos) << word;
  }
}

TEST(ManPage, RoffHasNoWarnings) {
  if (run({"/bin/sh", "-c", "command -v man"}, kShortLimit).exit_code != 0) GTEST_SKIP() << "man is not installed";
  for (const char* program : kPrograms) {
    const std::string render = std::string(program) + " man | man -l --warnings -E UTF-8 - 2>&1 > /dev/null";
    EXPECT_EQ(run({"/bin/sh", "-c", render}, kShortLimit).all(), "");
  }
}

}  // namespace

}  // namespace cellcrush::e2e
