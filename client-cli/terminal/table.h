#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terminal/display_text.h"

namespace cellcrush::client {

/// Lines of aligned columns, two blanks apart.
class Table {
 public:
  enum class Align { left, right };

  /// The first `keys` columns name what a row is about.
  explicit Table(std::vector<Align> columns, std::size_t keys = 0);

  /// A row with as many cells as there are columns; later cells may be left out.
  void add(std::vector<std::string> cells);

  /// A line over the whole width, above the rows that it names.
  void add_title(const std::string& title);

  /// Takes out the columns from number `first` on that say nothing: those with empty cells only and, of two or more
  /// rows, those in which all are the same. Returns what the latter say, as "heading value unit". The first `headings`
  /// rows are headings, the last of several one of units. REQUIRES: there is a row below them.
  std::vector<std::string> remove_constant_columns(std::size_t first, std::size_t headings);

  /// The lines, each beginning with `indent` blanks, none wider than `width` and without blanks at their
  /// ends; rows of empty cells have none. With keys
  /// the columns that have no room follow in a second block below, behind the keys again. Without, the
  /// columns are narrowed and their texts broken between words, figures never, as far as words of 20 letters allow;
  /// where that is not enough the first column is the key.
  [[nodiscard]] std::string text(int indent, int width) const;

 private:
  struct Row {
    std::vector<std::string> cells;
    bool is_title = false;  ///< then one cell
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

/// What Table::remove_constant_columns() took out, below the table: "\nThe same in all rows: ..."; empty for nothing.
std::string constants_text(const std::vector<std::string>& constants, int width);

}  // namespace cellcrush::client
