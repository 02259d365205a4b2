#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace cellcrush {

/// How a table's numbers are written: 3.41 between commas, or 3,41 between semicolons, which spreadsheets of many
/// languages expect.
enum class Decimal { point, comma };
constexpr Decimal decimal_of(bool comma) { return comma ? Decimal::comma : Decimal::point; }
inline constexpr const char* kDecimalCommaHelp =
    "Write CSV with decimal commas, and semicolons between columns, as spreadsheets in many languages expect";

/// The text of a CSV file, cell by cell. Numbers read back to the same bits.
class CsvText {
 public:
  explicit CsvText(Decimal decimal) : decimal_(decimal) {}

  /// Quoted if it contains a separator, a quote or a line break.
  void add(std::string_view text);
  void add(const char* text) { add(std::string_view(text)); }
  void add(const std::string& text) { add(std::string_view(text)); }
  void add(double value);
  void add(float value);
  void add(std::int64_t value);
  /// Nothing: an empty cell.
  void add(std::optional<double> value) { value ? add(*value) : add(std::string_view()); }
  /// Ends the row; each has one cell at least.
  void end_row();

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void begin_cell();
  template <class Number>
  void add_number(Number value);

  Decimal decimal_;
  std::string text_;
  bool in_row_ = false;
};

}  // namespace cellcrush
