#pragma once

#include <map>
#include <string>
#include <vector>

#include "docs/links.h"

namespace cellcrush::docs {

/// Rows of a table in Markdown. Numbers go to the right.
class PageTable {
 public:
  /// A head that begins with "#" is that of numbers.
  explicit PageTable(const std::vector<std::string>& heads);
  /// REQUIRES: as many cells as there are heads.
  void add_row(const std::vector<std::string>& cells);
  [[nodiscard]] std::string text() const { return text_; }

 private:
  void add_line(const std::vector<std::string>& cells);
  std::string text_;
};

/// Tables by the names that pages give them.
using PageTables = std::map<std::string, std::string>;

/// A page with its tables, and what is wrong with its marks.
struct FilledPage {
  std::string text;
  Findings findings;
};

/// Puts each table between its marks, lines of their own:
///   <!-- table: NAME -->
///   <!-- end of table -->
/// Marks without an end, names that are unknown and tables that have no place are findings.
FilledPage fill_tables(const std::string& page, const PageTables& tables);

// Numbers as cells show them; empty when not a number.

std::string fixed(double value, int decimals);
/// "1.3 ± 0.4 %", of shares.
std::string percent_of(double share, double uncertainty, int decimals);
std::string percent(double share, int decimals);
/// With the sign: "+1.3 %".
std::string signed_percent(double share, int decimals);

}  // namespace cellcrush::docs
