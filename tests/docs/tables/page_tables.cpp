#include "docs/tables/page_tables.h"

#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>

namespace cellcrush::docs {
namespace {

const std::string kBegin = "<!-- table: ";
const std::string kEnd = "<!-- end of table -->";

std::string print(const char* format, double value, int decimals) {
  if (!std::isfinite(value)) return "";
  char text[64];
  std::snprintf(text, sizeof(text), format, decimals, value);
  // What rounds to nothing has no sign.
  return std::string(text).find_first_of("123456789") == std::string::npos && text[0] != '0'
             ? std::string(text).substr(1)
             : text;
}

}  // namespace

PageTable::PageTable(const std::vector<std::string>& heads) {
  std::vector<std::string> names;
  std::vector<std::string> rules;
  for (const std::string& head : heads) {
    const bool is_number = head.starts_with("#");
    names.push_back(is_number ? head.substr(1) : head);
    rules.emplace_back(is_number ? "---:" : "---");
  }
  add_line(names);
  text_ += "|";
  for (const std::string& rule : rules) text_ += rule + "|";
  text_ += "\n";
}

void PageTable::add_row(const std::vector<std::string>& cells) { add_line(cells); }

void PageTable::add_line(const std::vector<std::string>& cells) {
  text_ += "|";
  for (const std::string& cell : cells) text_ += cell.empty() ? " |" : " " + cell + " |";
  text_ += "\n";
}

FilledPage fill_tables(const std::string& page, const PageTables& tables) {
  FilledPage filled;
  std::set<std::string> placed;
  std::istringstream lines(page);
  bool is_inside = false;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto report = [&](const std::string& what) {
      filled.findings.push_back("line " + std::to_string(number) + ": " + what);
    };
    if (line == kEnd) {
      if (!is_inside) report("ends a table that has not begun");
      is_inside = false;
    }
    if (!is_inside) filled.text += line + "\n";
    if (!line.starts_with(kBegin)) continue;
    if (is_inside) report("begins a table inside another");
    is_inside = true;
    const std::string name = line.substr(kBegin.size(), line.rfind(" -->") - kBegin.size());
    const auto table = tables.find(name);
    if (table == tables.end()) report("no such table: " + name);
    if (table != tables.end()) filled.text += "\n" + table->second + "\n";
    placed.insert(name);
  }
  if (is_inside) filled.findings.emplace_back("the last table has no end; write " + kEnd);
  for (const auto& [name, text] : tables) {
    if (!placed.contains(name)) filled.findings.push_back("not in the page: " + name);
  }
  return filled;
}

std::string fixed(double value, int decimals) { return print("%.*f", value, decimals); }

std::string percent(double share, int decimals) {
  return std::isfinite(share) ? fixed(100.0 * share, decimals) + " %" : "";
}

std::string signed_percent(double share, int decimals) {
  return std::isfinite(share) ? print("%+.*f", 100.0 * share, decimals) + " %" : "";
}

std::string percent_of(double share, double uncertainty, int decimals) {
  return std::isfinite(share) ? fixed(100.0 * share, decimals) + " ± " + percent(uncertainty, decimals) : "";
}

}  // namespace cellcrush::docs
