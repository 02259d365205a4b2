// tests/core/README.md has the numbers that the tests record, tests/load/README.md those of its programs, and
// tests/validation/README.md some of the first.
// CELLCRUSH_WRITE_PAGES=1 writes them into the pages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "docs/links.h"
#include "scenes/evidence.h"

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;

/// A page in which results name what tests recorded before they tell it: "worst error <!--error over L-->1.2e-4 L".
struct EvidencePage {
  std::string text;
  Findings findings;        ///< what is wrong with the text
  scenes::Evidence unused;  ///< rows of the record that the page does not name
};

constexpr const char* kByHand = "Results of this section are written by hand.";

/// The name of a quantity and the number behind it, of which a new row has none.
constexpr const char* kNumber = R"(<!--([^>]*)-->(-?[0-9]+(?:\.[0-9]+)?(?:e-?[0-9]+)?)?)";

/// Cells of a row of a table, each with the blanks around it; the first and the last are empty.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line + "|");
  for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(cell);
  return cells;
}

/// Patterns of the tests between backticks in a cell, without what parameters add before: ... stands for any letters.
std::vector<std::regex> patterns_of(const std::string& cell) {
  static const std::regex kName("`(?:[A-Za-z0-9_]+/)?([A-Za-z0-9_.]+)`");
  std::vector<std::regex> patterns;
  for (std::sregex_iterator name(cell.begin(), cell.end(), kName), end; name != end; ++name) {
    const std::string any = std::regex_replace((*name)[1].str(), std::regex(R"(\.\.\.)"), "*");
    const std::string dots = std::regex_replace(any, std::regex(R"(\.)"), "[.]");
    patterns.emplace_back(std::regex_replace(dots, std::regex(R"(\*)"), ".*"));
  }
  return patterns;
}

bool matches(const std::vector<std::regex>& patterns, const std::string& test) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const auto& each) { return std::regex_match(test, each); });
}

bool has_own_digits(const std::string& result) {
  static const std::regex kGiven(std::string(kNumber) + R"(|\bE[0-9]+|Eq\. [0-9]+|`[^`]*`)");
  return std::regex_search(std::regex_replace(result, kGiven, ""), std::regex("[0-9]"));
}

// Writes the numbers into the tables (claim, reference, result, test) of a page again. A name stands for the row of
// `evidence` that has its quantity and a test that the table's row names, with ... for any letters. Results have no
// digits but those of names, equations (E11, Eq. 51) and code, except in a section that says kByHand. Every test that
// is named is one of `tests`, and every row of `evidence` stands in the page.
EvidencePage make_evidence_page(const std::string& text, const scenes::Evidence& evidence,
                                const std::set<std::string>& tests) {
  static const std::regex kNumbers(kNumber);
  EvidencePage page;
  page.unused = evidence;
  std::istringstream lines(text);
  std::string line;
  bool by_hand = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto report = [&](const std::string& what) {
      page.findings.push_back("line " + std::to_string(number) + ": " + what);
    };
    by_hand = !line.starts_with("## ") && (by_hand || line.starts_with(kByHand));
    std::vector<std::string> cells = cells_of(line);
    if (cells.size() == 6 && cells[4] != " Test " && cells[4] != " Program " && cells[4] != "---") {
      const std::vector<std::regex> patterns = patterns_of(cells[4]);
      if (patterns.empty()) report("names no test");
      for (const std::regex& pattern : patterns) {
        if (std::none_of(tests.begin(), tests.end(), [&](const auto& test) { return matches({pattern}, test); }))
          report("no such test:" + cells[4]);
      }
      if (!by_hand && has_own_digits(cells[3])) report("a number that no test recorded:" + cells[3]);
      std::string result;
      std::string rest = cells[3];
      for (std::smatch match; std::regex_search(rest, match, kNumbers);) {
        const std::string name = match[1];
        std::string value;
        int found = 0;
        for (const auto& [key, recorded] : evidence) {
          if (key.second != name || !matches(patterns, key.first)) continue;
          value = recorded;
          page.unused.erase(key);
          ++found;
        }
        if (found != 1) report(std::to_string(found) + " rows for " + name);
        result += match.prefix().str() + "<!--" + name + "-->" + value;
        rest = match.suffix();
      }
      line = "|" + cells[1] + "|" + cells[2] + "|" + result + rest + "|" + cells[4] + "|";
    }
    page.text += line + "\n";
  }
  return page;
}

const fs::path kTests = fs::path(CELLCRUSH_SOURCE_ROOT) / "tests";

/// Suite.Name of all tests, and the programs that measure the service.
std::set<std::string> find_tests() {
  static const std::regex kTest(R"(\nTEST(?:_[FP])?\((\w+),\s*(\w+)\))");
  std::set<std::string> tests{"service_load", "forecasts", "time_forecasts"};
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kTests)) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = read_text(entry.path());
    for (std::sregex_iterator test(text.begin(), text.end(), kTest), end; test != end; ++test)
      tests.insert((*test)[1].str() + "." + (*test)[2].str());
  }
  return tests;
}

/// Holds the page of a folder of tests to a record, and writes it if told so.
EvidencePage check_page(const std::string& folder, const scenes::Evidence& evidence,
                        const std::set<std::string>& tests) {
  const fs::path file = kTests / folder / "README.md";
  const std::string text = read_text(file);
  EvidencePage made = make_evidence_page(text, evidence, tests);
  EXPECT_TRUE(made.findings.empty()) << folder << "\n" << to_text(made.findings);
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) std::ofstream(file) << made.text;
  EXPECT_EQ(text, made.text) << "evidence.csv has changed. Write its numbers into the page again: "
                                "CELLCRUSH_WRITE_PAGES=1 build/ci/bin/docs_evidence_page";
  return made;
}

TEST(EvidencePageTest, IsWhatTheTestsRecorded) {
  const std::set<std::string> tests = find_tests();
  EXPECT_GT(tests.size(), 100U);
  for (const std::string folder : {"core", "load"}) {
    const scenes::Evidence evidence = scenes::read_evidence(kTests / folder / "evidence.csv");
    const EvidencePage made = check_page(folder, evidence, tests);
    for (const auto& [key, value] : made.unused) ADD_FAILURE() << "not in the page: " << key.first << "," << key.second;
  }
}

TEST(EvidencePageTest, OfTheMainClaimsIsWhatTheTestsRecorded) {
  check_page("validation", scenes::read_evidence(kTests / "core" / "evidence.csv"), find_tests());
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
  EXPECT_THAT(made.findings,
              testing::ElementsAre("line 2: 0 rows for gone", "line 3: a number that no test recorded: within 1 % ",
                                   "line 4: no such test: `C...` ", "line 5: names no test"));
  EXPECT_THAT(made.unused, testing::ElementsAre(testing::Pair(testing::Pair("B.Two", "error"), "7")));
}

}  // namespace
}  // namespace cellcrush::docs
