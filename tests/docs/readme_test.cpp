// What an installation has, how long the README is, and how the commands of a page are typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "docs/session.h"
#include "docs/shown_output.h"
#include "programs/process.h"
#include "programs/temporary_folder.h"

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

constexpr std::chrono::seconds kLimit{240};

TEST(Install, PutsProgramsManualsAndCompletionsInTheirPlaces) {
  const TemporaryFolder folder;
  install(folder.path());
  for (const char* file :
       {"bin/cellcrush", "bin/cellcrushd", "share/man/man1/cellcrush.1", "share/bash-completion/completions/cellcrush",
        "share/zsh/site-functions/_cellcrush", "share/fish/vendor_completions.d/cellcrush.fish"}) {
    EXPECT_TRUE(fs::is_regular_file(folder.path() / file)) << file;
  }
  const e2e::Outcome outcome =
      e2e::run({(folder.path() / "bin/cellcrush").string(), "--version"}, std::chrono::seconds(30));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
}

TEST(Readme, IsAPage) {
  const fs::path file = fs::path(CELLCRUSH_SOURCE_ROOT) / "README.md";
  const e2e::Outcome words = e2e::run({"/usr/bin/wc", "-w", file.string()}, std::chrono::seconds(30));
  EXPECT_LE(std::stoi(words.output), 1000) << "what a reader need not know first belongs on another page";
}

TEST(Session, StopsAtTheCommandThatFails) {
  const TemporaryFolder folder;
  const Page page = parse_page("page.md", "```console\n$ echo 12 MPa\n34 MPa\n$ false\n$ echo never\n```\n");
  const std::vector<StepOutcome> outcomes = run_session(steps_of(page), folder.path(), "/nowhere", kLimit);
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(outcomes[0].exit_code, 0);
  EXPECT_EQ(outcomes[1].exit_code, 1);
}

TEST(Session, WritesWhatCommandsPrintIntoThePage) {
  const std::string text = "1. Text\n   ```console\n   $ a \\\n     b\n   1\n\n   ...\n\n   $ c\n   2\n   ```\n";
  const std::vector<Step> steps = steps_of(parse_page("page.md", text));
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(with_shown(text, steps, {steps[0].shown, steps[1].shown}), text);
  EXPECT_EQ(with_shown(text, steps, {{"3", "", "4", "..."}}),
            "1. Text\n   ```console\n   $ a \\\n     b\n   3\n\n   4\n   ...\n\n   $ c\n   2\n   ```\n");
}

TEST(ShownOutput, IsThatOfTheProgramButForVolatileValues) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(show_again({"plateau  3.31 MPa", "...", "took 7 s"}, "plateau  3.29 MPa\nmore\n\ntook 12.5 s\n\n"),
            (Lines{"plateau  3.29 MPa", "...", "took 7 s"}));
  EXPECT_EQ(show_again({"a", "took      7.3 s"}, "a\ntook    120.25 s\n"), (Lines{"a", "took      7.3 s"}));
  EXPECT_EQ(show_again({"JOB  STARTS IN", "a      7.3 s"}, "JOB   STARTS IN\na    1 min 20 s\n"),
            (Lines{"JOB  STARTS IN", "a      7.3 s"}));
  EXPECT_EQ(show_again({"step 2.5e-07 s"}, "step 2.5e-08 s\n"), Lines{"step 2.5e-08 s"});
  EXPECT_EQ(show_again({"on 127.0.0.1:8080 at 2026-11-23T17:01:26Z"}, "on 127.0.0.1:49152 at 2027-01-02T03:04:05Z"),
            Lines{"on 127.0.0.1:8080 at 2026-11-23T17:01:26Z"});
}

TEST(ShownOutput, FollowsLinesWhoseWordsChange) {
  using Lines = std::vector<std::string>;
  // The row of a table that begins with the same words, though all have other figures.
  EXPECT_EQ(show_again({"m/s  MPa", "25  0.497", "...", "200  12.8"}, "m/s  kPa\n 25  503\n 50  1130\n200  12.7\n"),
            (Lines{"m/s  kPa", " 25  503", "...", "200  12.7"}));
  EXPECT_EQ(show_again({"...", "error of the mesh  1 %", "..."}, "a\nb\nerror of the first mesh  2 %\nc"),
            (Lines{"...", "error of the first mesh  2 %", "..."}));
  // Lines between shown ones and behind the last join; those that are gone go.
  EXPECT_EQ(show_again({"a", "b", "c"}, "a\n\nnew\nb\nlast line\n"), (Lines{"a", "", "new", "b", "last line"}));
  EXPECT_EQ(show_again({"...", "gone for good", "..."}, "a\n"), (Lines{"...", "..."}));
}

}  // namespace
}  // namespace cellcrush::docs
