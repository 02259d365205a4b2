// Completion scripts and the man page, which are made from the definition that the program parses with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "fake_server.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

// Words of the main help and of the helps of all its commands: the commands, and their options that begin with "--".
std::set<std::string> commands_and_options() {
  std::set<std::string> words;
  std::vector<std::vector<std::string>> helps = {{"--help"}};
  for (std::size_t i = 0; i < helps.size(); ++i) {
    std::istringstream lines(run_program(helps[i]).output);
    for (std::string line; std::getline(lines, line) && line != "Examples:";) {
      if (!line.starts_with("  ") || line[2] == ' ') continue;
      std::string names = line.substr(2, line.find(' ', 2) - 2);
      if (i == 0 && names[0] != '-') helps.push_back({names, "--help"});
      std::istringstream parts(names);
      for (std::string name; std::getline(parts, name, ',');) {
        if (name.starts_with("--") || (i == 0 && name[0] != '-')) words.insert(name);
      }
    }
  }
  return words;
}

std::string output_of(const std::vector<std::string>& words) {
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return result.output;
}

// What bash prints after it has run a script.
std::string run_bash(const std::string& script) {
  const FakeServer folder_of_its_own({});
  const std::filesystem::path file = folder_of_its_own.folder() / "script";
  const std::filesystem::path output = folder_of_its_own.folder() / "output";
  std::ofstream(file) << script;
  EXPECT_EQ(std::system(("bash '" + file.string() + "' > '" + output.string() + "' 2>&1").c_str()), 0);
  return read_file(output);
}

std::string complete_with_bash(const std::string& words) {
  return run_bash(output_of({"completion", "bash"}) + "COMP_WORDS=(" + (words.ends_with(' ') ? words + "''" : words) +
                  ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_cellcrush\necho \"${COMPREPLY[@]}\"\n");
}

TEST(Completion, NamesEveryCommandAndEveryLongOption) {
  const std::set<std::string> words = commands_and_options();
  EXPECT_GT(words.size(), 40U);
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const std::string script = output_of({"completion", shell});
    const bool fish = std::string(shell) == "fish";
    for (const std::string& word : words) {
      const std::string name = fish && word.starts_with("--") ? "-l " + word.substr(2) : word;
      EXPECT_NE(script.find(name), std::string::npos) << shell << ": " << word;
    }
    EXPECT_EQ(script.find("completion SHELL"), std::string::npos);
  }
}

TEST(Completion, BashCompletesCommandsAndOptions) {
  EXPECT_EQ(complete_with_bash("cellcrush su"), "submit suspend\n");
  EXPECT_EQ(complete_with_bash("cellcrush submit --wa"), "--watch\n");
  EXPECT_EQ(complete_with_bash("cellcrush --json list --li"), "--limit\n");
  EXPECT_EQ(complete_with_bash("cellcrush list --tls-c"), "--tls-ca --tls-cert\n");
  EXPECT_EQ(complete_with_bash("cellcrush check my"), "\n") << "files are bash's own";
}

TEST(Completion, BashCompletesPresetsChoicesFieldsAndNames) {
  EXPECT_EQ(complete_with_bash("cellcrush check preset:papka-kyriakides-"), "papka-kyriakides-1 papka-kyriakides-2\n")
      << "what stands before the colon is a word of its own";
  EXPECT_EQ(complete_with_bash("cellcrush run preset : type-iii-as-s"), "type-iii-as-stated\n");
  EXPECT_EQ(complete_with_bash("cellcrush sweep preset :").substr(0, 14), "hexagon-small ");
  EXPECT_EQ(complete_with_bash("cellcrush show pres").substr(0, 20), "preset:hexagon-small");
  EXPECT_EQ(complete_with_bash("cellcrush submit a --set loading.sp"), "loading.speed_m_per_s=\n");
  EXPECT_EQ(complete_with_bash("cellcrush explain loading.sp"), "loading.speed_m_per_s\n");
  EXPECT_EQ(complete_with_bash("cellcrush plot sweeps/1 --log x"), "x xy\n");
  EXPECT_EQ(complete_with_bash("cellcrush watch "), "jobs/ sweeps/\n");
  EXPECT_EQ(complete_with_bash("cellcrush table s"), "sweeps/\n");
  EXPECT_EQ(complete_with_bash("cellcrush fetch jobs/1 -o pre"), "\n") << "files are bash's own";
}

TEST(Completion, OtherShellsAreRefused) { EXPECT_EQ(run_program({"completion", "tcsh"}).exit_code, 2); }

TEST(ManPage, NamesEveryCommandAndEveryLongOption) {
  std::string page = output_of({"man"});
  EXPECT_TRUE(page.starts_with(".TH CELLCRUSH 1 "));
  for (const char* section : {".SH NAME\n", ".SH SYNOPSIS\n", ".SH DESCRIPTION\n", ".SH OPTIONS\n", ".SH COMMANDS\n"}) {
    EXPECT_NE(page.find(section), std::string::npos) << section;
  }
  page.erase(std::remove(page.begin(), page.end(), '\\'), page.end());
  for (const std::string& word : commands_and_options()) EXPECT_NE(page.find(word), std::string::npos) << word;
}

TEST(ManPage, RoffHasNoWarnings) {
  if (std::system("command -v man > /dev/null 2>&1") != 0) GTEST_SKIP() << "man is not installed";
  EXPECT_EQ(run_bash("cat > \"$0.1\" <<'END'\n" + output_of({"man"}) +
                     "END\nman -l --warnings -E UTF-8 \"$0.1\" 2>&1 "
                     "> /dev/null\n"),
            "");
}

}  // namespace
}  // namespace cellcrush::client::testing
