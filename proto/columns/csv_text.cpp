#include "columns/csv_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace cellcrush {

void CsvText::begin_cell() {
  if (in_row_) text_ += decimal_ == Decimal::comma ? ';' : ',';
  in_row_ = true;
}

void CsvText::add(std::string_view text) {
  begin_cell();
  if (text.find_first_of(",;\"\r\n") == std::string_view::npos) {
    text_ += text;
    return;
  }
  text_ += '"';
  for (const char byte : text) {
    if (byte == '"') text_ += '"';
    text_ += byte;
  }
  text_ += '"';
}

template <class Number>
void CsvText::add_number(Number value) {
  begin_cell();
  const auto start = static_cast<std::ptrdiff_t>(text_.size());
  fmt::format_to(std::back_inserter(text_), "{}", value);
  if (decimal_ == Decimal::comma) std::replace(text_.begin() + start, text_.end(), '.', ',');
}

void CsvText::add(double value) { add_number(value); }
void CsvText::add(float value) { add_number(value); }
void CsvText::add(std::int64_t value) { add_number(value); }

void CsvText::end_row() {
  text_ += '\n';
  in_row_ = false;
}

}  // namespace cellcrush
