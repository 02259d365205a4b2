#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "terminal/printable.h"

namespace cellcrush::client {

/// Columns that `text` (UTF-8) takes on a terminal, a character a column.
int display_width(std::string_view text);

/// `text` cut to `width` columns, with "..." at the cut where there is room for it.
std::string cut(std::string_view text, int width);

/// Lines of aligned columns, two blanks apart.
class Table {
 public:
  enum class Align { left, right };

  explicit Table(std::vector<Align> columns);

  /// A row with as many cells as there are columns; later cells may be left out.
  void add(std::vector<std::string> cells);

  /// The lines, each beginning with `indent` blanks, without blanks at their ends.
  [[nodiscard]] std::string text(int indent = 0) const;

 private:
  std::vector<Align> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace cellcrush::client
