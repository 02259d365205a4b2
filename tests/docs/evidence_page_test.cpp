// tests/core/README.md has the numbers that the tests record. CELLCRUSH_WRITE_PAGES=1 writes them into it.
#include "docs/evidence_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;

const fs::path kTests = fs::path(CELLCRUSH_SOURCE_ROOT) / "tests";
const fs::path kFolder = kTests / "core";

/// Suite.Name of all tests.
std::set<std::string> find_tests() {
  static const std::regex kTest(R"(\nTEST(?:_[FP])?\((\w+),\s*(\w+)\))");
  std::set<std::string> tests;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kTests)) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = read_text(entry.path());
    for (std::sregex_iterator test(text.begin(), text.end(), kTest), end; test != end; ++test)
      tests.insert((*test)[1].str() + "." + (*test)[2].str());
  }
  return tests;
}

TEST(EvidencePageTest, IsWhatTheTestsRecorded) {
  const std::set<std::string> tests = find_tests();
  EXPECT_GT(tests.size(), 100U);
  const std::string text = read_text(kFolder / "README.md");
  const EvidencePage made = make_evidence_page(text, scenes::read_evidence(kFolder / "evidence.csv"), tests);
  EXPECT_TRUE(made.findings.empty()) << to_text(made.findings);
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) std::ofstream(kFolder / "README.md") << made.text;
  EXPECT_EQ(text, made.text) << "evidence.csv has changed. Write its numbers into the page again: "
                                "CELLCRUSH_WRITE_PAGES=1 build/ci/bin/docs_evidence_page";
}

TEST(EvidencePageTest, WhatNoTestRecordedIsFound) {
  const EvidencePage made = make_evidence_page(
      "| a | b | to <!--error-->7.5e-3, <!--new--> at E11 | `A.One...` |\n"
      "| a | b | <!--gone-->1 | `A...` |\n"
      "| a | b | within 1 % | `B.Two` |\n"
      "| a | b | none | `C...` |\n"
      "| a | b | none | without a name |\n"
      "## By hand\n\nResults of this section are written by hand.\n"
      "| a | b | within 1 % | `Each/B.Tw...` |\n",
      {{{"A.OneMore", "error"}, "1.2"}, {{"A.OneMore", "new"}, "-3"}, {{"B.Two", "error"}, "7"}},
      {"A.OneMore", "B.Two"});
  EXPECT_TRUE(made.text.starts_with("| a | b | to <!--error-->1.2, <!--new-->-3 at E11 | `A.One...` |\n")) << made.text;
  EXPECT_THAT(
      made.findings,
      testing::ElementsAre("line 2: 0 rows for gone", "line 3: a number that no test recorded: within 1 % ",
                           "line 4: no such test: `C...` ", "line 5: names no test", "not in the page: B.Two,error"));
}

}  // namespace
}  // namespace cellcrush::docs
