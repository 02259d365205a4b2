// Completion scripts, which are made from the definition that the program parses with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "fake_server.h"
#include "program.h"
#include "programs/program_help.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string output_of(const std::vector<std::string>& words) {
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return result.output;
}

std::string complete_with_bash(const std::string& words, const std::string& before = "") {
  const std::string script = output_of({"completion", "bash"}) + before + "COMP_WORDS=(" +
                             (words.ends_with(' ') ? words + "''" : words) +
                             ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_cellcrush\necho \"${COMPREPLY[@]}\"\n";
  return e2e::run({"/bin/bash", "-c", script}, std::chrono::seconds(30)).all();
}

TEST(Completion, NamesEveryCommandAndEveryLongOption) {
  const e2e::ProgramHelp help = e2e::read_help(CELLCRUSH_PROGRAM);
  std::set<std::string> words = help.options;
  for (const auto& [command, options] : help.commands) {
    words.insert(command);
    words.insert(options.begin(), options.end());
  }
  std::erase_if(words, [](const std::string& word) { return word[0] == '-' && word[1] != '-'; });
  EXPECT_GT(words.size(), 40U);
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const std::string script = output_of({"completion", shell});
    const bool fish = std::string(shell) == "fish";
    for (const std::string& word : words) {
      const std::string name = fish && word.starts_with("--") ? "-l " + word.substr(2) : word;
      EXPECT_THAT(script, HasSubstr(name)) << shell << ": " << word;
    }
    EXPECT_THAT(script, Not(HasSubstr("completion SHELL")));
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

TEST(Completion, OffersTheNamesOfTheServer) {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.job.set_name("jobs/3");
  script.sweeps.sweep.set_name("sweeps/5");
  const FakeServer server(script);
  const std::string before = "cellcrush() { '" CELLCRUSH_PROGRAM "' --server " + server.address() + " \"$@\"; }\n";
  EXPECT_EQ(complete_with_bash("cellcrush watch ", before), "jobs/3 sweeps/5\n");
  EXPECT_EQ(complete_with_bash("cellcrush table ", before), "sweeps/5\n");
  EXPECT_EQ(complete_with_bash("cellcrush fetch jobs/", before), "jobs/3\n");
  // The others take the same lines; what they make of them shows where they are installed.
  EXPECT_THAT(server.run({"completion", "names"}).output, HasSubstr("jobs/3\tSUCCEEDED "));
  if (access("/usr/bin/fish", X_OK) != 0) return;
  const std::string fish = "function cellcrush; '" CELLCRUSH_PROGRAM "' --server " + server.address() +
                           " $argv; end\n" + output_of({"completion", "fish"}) + "complete -C 'cellcrush watch '\n";
  EXPECT_THAT(e2e::run({"/usr/bin/fish", "-c", fish}, std::chrono::seconds(30)).all(), HasSubstr("jobs/3\tSUCCEEDED"));
}

TEST(Completion, OtherShellsAreRefused) { EXPECT_EQ(run_program({"completion", "tcsh"}).exit_code, 2); }

}  // namespace
}  // namespace cellcrush::client::testing
