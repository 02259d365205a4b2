// What an installation has, how long the README is, and how the commands of a page are typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "docs/session.h"
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

TEST(Session, ComparesLinesButForTheirNumbers) {
  EXPECT_EQ(missing_line({"plateau  3.31 MPa", "...", "took 7 s"}, "plateau 3.29 MPa\nmore\n\ntook 12.5 s\n"), "");
  EXPECT_EQ(missing_line({"plateau 3.31 MPa", "took 7 s"}, "plateau 3.29 MPa\nmore\ntook 12.5 s\n"), "took 7 s");
  EXPECT_EQ(missing_line({"plateau 3.31 mm"}, "plateau 3.31 MPa\n"), "plateau 3.31 mm");
  EXPECT_EQ(missing_line({"1 MPa", "...", "2 MPa", "end"}, "1 MPa\n2 MPa\n3 MPa\nend\n"), "");
  EXPECT_EQ(missing_line({"...", "2 MPa", "end"}, "1 MPa\n2 MPa\n"), "end");
  EXPECT_EQ(masked("jobs/ab-12   -1.5e-7 ----"), masked("jobs/c 3 --"));
}

}  // namespace
}  // namespace cellcrush::docs
