#include "docs/evidence_page.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <utility>
#include <vector>

namespace cellcrush::docs {
namespace {

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

}  // namespace

EvidencePage make_evidence_page(const std::string& text, const scenes::Evidence& evidence,
                                const std::set<std::string>& tests) {
  static const std::regex kNumbers(kNumber);
  EvidencePage page;
  scenes::Evidence unused = evidence;
  std::istringstream lines(text);
  std::string line;
  bool by_hand = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto report = [&](const std::string& what) {
      page.findings.push_back("line " + std::to_string(number) + ": " + what);
    };
    by_hand = !line.starts_with("## ") && (by_hand || line.starts_with(kByHand));
    std::vector<std::string> cells = cells_of(line);
    if (cells.size() == 6 && cells[4] != " Test " && cells[4] != "---") {
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
          unused.erase(key);
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
  for (const auto& [key, value] : unused) page.findings.push_back("not in the page: " + key.first + "," + key.second);
  return page;
}

}  // namespace cellcrush::docs
