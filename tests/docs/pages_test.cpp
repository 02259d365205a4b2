// Every block of every page is run as a reader would run it, or says why not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "docs/links.h"
#include "docs/session.h"

namespace cellcrush::docs {
namespace {

using ::testing::ElementsAre;

// What tests/slurm types on a cluster of its own.
const std::set<std::string> kOnACluster = {"deploy/slurm/executor.md", "deploy/slurm/job-array.md"};

struct Circumstances {
  Reader reader = Reader::caller;
  std::map<std::string, std::string> instead = {};
  std::vector<std::string> before = {};
};
const std::map<std::string, Circumstances> kCircumstances = {
    // The local disk and the port are the test's own.
    {"deploy/slurm/login-node.md",
     {Reader::ordinary_user, {{"/var/tmp/", "$HOME/disk/"}, {"$((20000 + UID % 10000))", "0"}}}},
    // Examples of the help: each finds jobs and sweeps in the state it is about, and small ones.
    {"client-cli/commands.md",
     {Reader::caller,
      {{"show preset:type-i", "show preset:hexagon-small"},
       {"submit preset:type-i", "submit preset:hexagon-small"},
       {"sweep preset:type-i", "sweep preset:hexagon-small"},
       {"cancel jobs/12", "cancel jobs/14"},
       {"cancel sweeps/3", "cancel sweeps/1"},
       {"suspend jobs/12", "suspend jobs/15"},
       {"resume jobs/12", "resume jobs/15"},
       {"delete jobs/12", "delete jobs/9"},
       {"delete sweeps/3", "delete sweeps/2"},
       {"converge sweeps/3", "converge sweeps/7"}},
      {"cellcrushd --workers 4 > cellcrushd.log 2>&1 &", "cellcrush show preset:hexagon-small > my.txtpb",
       R"(printf 'x1,y1,x2,y2\n0,0,5,5\n5,5,0,9\n' > foam.csv)",
       R"(printf 'strain,stress MPa\n0,0\n0.1,0.3\n0.5,0.3\n' > test.csv)",
       "for i in 1 2 3 4; do cellcrush sweep my.txtpb --over loading.speed_m_per_s=50,100 --watch; done > log",
       "for i in 9 10 11 12 13; do cellcrush submit my.txtpb --watch; done > log",
       "for o in thin thick; do cellcrush run my.txtpb -o $o; done > log",
       "for i in 14 15; do cellcrush submit my.txtpb --set loading.speed_m_per_s=0.5; done > log"}}}};

const std::vector<Page>& pages() {
  static const std::vector<Page> kPages = read_pages(CELLCRUSH_SOURCE_ROOT);
  return kPages;
}

std::vector<std::string> pages_with_steps() {
  std::vector<std::string> paths;
  for (const Page& page : pages()) {
    if (!steps_of(page).empty() && !kOnACluster.contains(page.path)) paths.push_back(page.path);
  }
  return paths;
}

// Whether a command or another file of the page uses the file, by its name or as the one that the program looks for.
bool is_used(const Page& page, const Code& saved) {
  static const std::map<std::string, std::string> kLookedFor = {
      {"CMakeLists.txt", "cmake "}, {"Makefile", "make "}, {"Snakefile", "snakemake "}};
  const std::string name = std::filesystem::path(saved.file).filename();
  const auto known = kLookedFor.find(name);
  return std::ranges::any_of(page.blocks, [&](const Code& block) {
    return block.line != saved.line &&
           block.text.find(known == kLookedFor.end() ? name : known->second) != std::string::npos;
  });
}

// Blocks of code that nobody runs.
Findings idle_blocks(const Page& page) {
  static const std::set<std::string> kNoCode = {"", "text"};
  static const std::set<std::string> kTyped = {"console", "sh", "run", "python"};
  Findings findings;
  for (const Code& block : page.blocks) {
    if (!block.excuse.empty() || kNoCode.contains(block.language)) continue;
    if (!block.file.empty() && !is_used(page, block)) {
      findings.push_back(place_of(page, block.line) + "no command uses " + block.file);
    } else if (block.file.empty() && !kTyped.contains(block.language)) {
      findings.push_back(place_of(page, block.line) + block.language +
                         " that does not run: \"save this as `FILE`\" and use it, or <!-- not run: REASON -->");
    }
  }
  return findings;
}

TEST(Pages, HaveNoBlockThatNeitherRunsNorSaysWhyNot) {
  Findings findings;
  for (const Page& page : pages()) {
    const Findings found = idle_blocks(page);
    findings.insert(findings.end(), found.begin(), found.end());
  }
  EXPECT_TRUE(findings.empty()) << to_text(findings);
}

TEST(Pages, WithABlockThatDoesNotRunAreFound) {
  const Page page = parse_page("page.md",
                               "Save this as `a.py`:\n\n```python\n```\n\n```cpp\n```\n<!-- not run: reason -->\n"
                               "```go\n```\n\n```text\n```\nSave it\nas `b.py`:\n```python\n```\n```sh\npython3 b.py\n"
                               "# remark\necho 1 \\\n  2\n```\n<!-- run: a -->\n```console\n$ b\nB\n```\n"
                               "```python\nf()\n```\n");
  EXPECT_THAT(idle_blocks(page),
              ElementsAre("page.md:4: no command uses a.py",
                          "page.md:7: cpp that does not run: \"save this as `FILE`\" and use it, or <!-- not run: "
                          "REASON -->"));
  std::vector<std::string> commands;
  for (const Step& step : steps_of(page)) commands.push_back(step.command);
  EXPECT_THAT(commands, ElementsAre("mkdir -p $(dirname a.py) && cat > a.py <<'@@ file'\n@@ file",
                                    "mkdir -p $(dirname b.py) && cat > b.py <<'@@ file'\n@@ file", "python3 b.py",
                                    "echo 1 \\\n  2", "a", "b",
                                    "mkdir -p $(dirname ~/.session/page.py) && cat >> ~/.session/page.py <<'@@ file'\n"
                                    "f()\n@@ file",
                                    "python3 ~/.session/page.py"));
}

// Stresses and energies in the prose of a page that none of its blocks has: copied by hand from a run that nobody
// repeats.
Findings stale_figures(const Page& page, const std::string& text) {
  static const std::regex kFigure(R"(([0-9][0-9.]*) (MPa|kPa|mJ|J)\b)");
  std::string shown;
  for (const Code& block : page.blocks) shown += block.text;
  Findings findings;
  std::istringstream lines(text);
  bool in_block = false;
  int number = 1;
  for (std::string line; std::getline(lines, line); ++number) {
    if (line.starts_with("```")) in_block = !in_block;
    if (in_block) continue;
    for (std::sregex_iterator figure(line.begin(), line.end(), kFigure), end; figure != end; ++figure) {
      const std::string value = std::regex_replace((*figure)[1].str(), std::regex("[.]"), "[.]");
      if (!std::regex_search(shown, std::regex("(^|[^0-9.])" + value + "([^0-9.]|$)")))
        findings.push_back(place_of(page, number) + "no block of the page has " + figure->str());
    }
  }
  return findings;
}

TEST(Pages, OfTheCommandLineHaveNoResultThatTheirCommandsDoNotShow) {
  Findings findings;
  for (const Page& page : pages()) {
    if (page.path != "README.md" && !page.path.starts_with("client-cli/")) continue;
    const Findings found = stale_figures(page, read_text(std::filesystem::path(CELLCRUSH_SOURCE_ROOT) / page.path));
    findings.insert(findings.end(), found.begin(), found.end());
  }
  EXPECT_TRUE(findings.empty()) << to_text(findings);
}

TEST(Pages, WithAFigureOfNoCommandAreFound) {
  const std::string text = "It is 3.4 MPa, not 3.5 MPa\nor 12 kPa.\n```\n$ a\n  3.4 MPa\n 112\n```\n";
  EXPECT_THAT(stale_figures(parse_page("page.md", text), text),
              ElementsAre("page.md:1: no block of the page has 3.5 MPa", "page.md:2: no block of the page has 12 kPa"));
}

class PageTest : public ::testing::TestWithParam<std::string> {};

TEST_P(PageTest, DoesWhatItShows) {
  const auto found = kCircumstances.find(GetParam());
  const Circumstances circumstances = found == kCircumstances.end() ? Circumstances{} : found->second;
  expect_shown(GetParam(), circumstances.reader, circumstances.instead, circumstances.before);
}

INSTANTIATE_TEST_SUITE_P(Each, PageTest, ::testing::ValuesIn(pages_with_steps()), [](const auto& parameter) {
  return std::regex_replace(parameter.param, std::regex("[^A-Za-z0-9]"), "_");
});

}  // namespace
}  // namespace cellcrush::docs
