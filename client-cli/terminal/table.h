#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chart/display_text.h"

namespace cellcrush::client {

/// Aligned columns, separated by two spaces.
class Table {
 public:
  enum class Align { left, right };

  /// The first `keys` columns identify a row.
  explicit Table(std::vector<Align> columns, std::size_t keys = 0);

  /// Adds a row with one cell per column; trailing cells may be omitted.
  void add(std::vector<std::string> cells);

  /// Adds a full-width line above the rows that it titles.
  void add_title(const std::string& title);

  /// Removes uninformative columns from number `first` on: empty ones and, with two or more rows, constant ones.
  /// Returns the constant ones as "heading value unit". The first `headings` rows are headings, the last of several
  /// being units. REQUIRES: at least one row below them.
  std::vector<std::string> remove_constant_columns(std::size_t first, std::size_t headings);

  /// The lines, each indented by `indent` spaces, at most `width` wide and without trailing spaces; a row of empty
  /// cells is an empty line. With keys, columns that do not fit follow in a second block with the keys repeated.
  /// Without, columns are narrowed by wrapping texts (never numbers) as long as words of 20 letters fit; beyond that
  /// the first column becomes the key.
  [[nodiscard]] std::string text(int indent, int width) const;

 private:
  struct Row {
    std::vector<std::string> cells;
    bool is_title = false;  ///< a single cell
  };

  [[nodiscard]] std::string constant_text(std::size_t column, std::size_t headings, const std::string& value) const;
  [[nodiscard]] std::vector<int> natural_widths() const;
  void narrow(std::vector<int>& widths, int room, Align align,
              const std::function<int(std::string_view cell)>& least) const;
  void narrow(std::vector<int>& widths, int room) const;
  [[nodiscard]] std::vector<int> widened(std::vector<int> widths, const std::vector<std::size_t>& columns,
                                         int room) const;
  [[nodiscard]] std::string block(int indent, int width, const std::vector<int>& widths,
                                  const std::vector<std::size_t>& columns) const;

  std::vector<Align> columns_;
  std::size_t keys_;
  std::vector<Row> rows_;
};

/// The columns removed by Table::remove_constant_columns(), as text below the table: "\nThe same in all rows: ...";
/// empty if there are none.
std::string constants_text(const std::vector<std::string>& constants, int width);

}  // namespace cellcrush::client
