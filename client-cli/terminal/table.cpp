#include "terminal/table.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <string_view>

namespace cellcrush::client {

namespace {

constexpr int kColumnGap = 2;

bool is_letter(char character) { return std::isalpha(static_cast<unsigned char>(character)) != 0; }

int longest_word(std::string_view text) {
  int longest = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    longest = std::max(longest, display_width(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return longest;
}

int total_width(const std::vector<int>& widths) {
  return std::accumulate(widths.begin(), widths.end(), kColumnGap * (static_cast<int>(widths.size()) - 1));
}

}  // namespace

Table::Table(std::vector<Align> columns, std::size_t keys) : columns_(std::move(columns)), keys_(keys) {}

void Table::add(std::vector<std::string> cells) {
  for (std::string& cell : cells) {
    cell = printable(cell);
    std::replace(cell.begin(), cell.end(), '\n', ' ');
  }
  cells.resize(columns_.size());
  rows_.push_back({std::move(cells)});
}

void Table::add_title(const std::string& title) { rows_.push_back({{printable(title)}, true}); }

std::vector<std::string> Table::remove_constant_columns(std::size_t first, std::size_t headings) {
  std::vector<std::string> constants;
  const auto first_row = std::find_if(rows_.begin() + static_cast<std::ptrdiff_t>(headings), rows_.end(),
                                      [](const Row& row) { return !row.is_title; });
  for (std::size_t column = columns_.size(); column-- > first;) {
    const std::string value = first_row->cells[column];
    const bool same =
        std::all_of(first_row, rows_.end(), [&](const Row& row) { return row.is_title || row.cells[column] == value; });
    if (!same || (!value.empty() && rows_.end() - first_row < 2)) continue;
    if (!value.empty()) constants.insert(constants.begin(), constant_text(column, headings, value));
    columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(column));
    for (Row& row : rows_) {
      if (!row.is_title) row.cells.erase(row.cells.begin() + static_cast<std::ptrdiff_t>(column));
    }
  }
  return constants;
}

// "crush mode layer by layer", "shock theory 3.41 MPa", "front strain none": the last of several headings is a unit.
std::string Table::constant_text(std::size_t column, std::size_t headings, const std::string& value) const {
  std::string text;
  for (std::size_t row = 0; row < std::max<std::size_t>(headings, 2) - 1; ++row) {
    const std::string& heading = rows_[row].cells[column];
    text += heading + (heading.empty() || heading.ends_with('-') ? "" : " ");
  }
  if (value == "-") return text + "none";
  text += value;
  const std::string unit = headings > 1 ? rows_[headings - 1].cells[column] : std::string();
  const bool is_number = value.find_first_of("0123456789") != std::string::npos;
  return text + (unit.empty() || !is_number ? "" : " " + unit);
}

std::vector<int> Table::natural_widths() const {
  std::vector<int> widths(columns_.size(), 0);
  for (const Row& row : rows_) {
    if (row.is_title) continue;
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], display_width(row.cells[i]));
  }
  return widths;
}

// Narrows the columns of one alignment from last to first, no further than `least`.
void Table::narrow(std::vector<int>& widths, int room, Align align,
                   const std::function<int(std::string_view cell)>& least) const {
  for (std::size_t i = columns_.size(); i-- > 0;) {
    if (columns_[i] != align) continue;
    int lowest = 0;
    for (const Row& row : rows_) {
      if (!row.is_title) lowest = std::max(lowest, least(row.cells[i]));
    }
    widths[i] = std::clamp(widths[i] - (total_width(widths) - room), std::min(lowest, widths[i]), widths[i]);
  }
}

// First texts while they stay easy to read, then the headings of numbers, then texts further.
void Table::narrow(std::vector<int>& widths, int room) const {
  const auto text = [](int comfortable, int longest) {
    return [comfortable, longest](std::string_view cell) {
      return std::max(std::min(display_width(cell), comfortable), std::min(longest_word(cell), longest));
    };
  };
  narrow(widths, room, Align::left, text(20, 40));
  narrow(widths, room, Align::right, [](std::string_view cell) {
    return !cell.empty() && is_letter(cell.front()) ? longest_word(cell) : display_width(cell);
  });
  narrow(widths, room, Align::left, text(8, 20));
}

// Widens left-aligned columns again if `room` is left for their texts.
std::vector<int> Table::widened(std::vector<int> widths, const std::vector<std::size_t>& columns, int room) const {
  const std::vector<int> natural = natural_widths();
  for (const std::size_t column : columns) room -= widths[column];
  room -= kColumnGap * (static_cast<int>(columns.size()) - 1);
  for (const std::size_t column : columns) {
    if (columns_[column] == Align::right) continue;
    const int more = std::clamp(natural[column] - widths[column], 0, std::max(room, 0));
    widths[column] += more;
    room -= more;
  }
  return widths;
}

std::string Table::block(int indent, int width, const std::vector<int>& widths,
                         const std::vector<std::size_t>& columns) const {
  std::string text;
  const std::string blanks(static_cast<std::size_t>(indent), ' ');
  for (const Row& row : rows_) {
    if (row.is_title) {
      text += wrapped(row.cells[0], width, blanks, blanks);
      continue;
    }
    std::vector<std::vector<std::string>> cells;
    std::size_t height = 1;
    for (const std::size_t column : columns) {
      // A cell that fits keeps its spaces.
      const bool fits = display_width(row.cells[column]) <= widths[column];
      cells.push_back(fits ? std::vector{breakable(row.cells[column])} : wrap_words(row.cells[column], widths[column]));
      height = std::max(height, cells.back().size());
    }
    for (std::size_t number = 0; number < height; ++number) {
      std::string line = blanks;
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::string& cell = number < cells[i].size() ? cells[i][number] : std::string();
        const std::string padding(static_cast<std::size_t>(widths[columns[i]] - display_width(cell)), ' ');
        line += (i == 0 ? "" : std::string(kColumnGap, ' ')) +
                (columns_[columns[i]] == Align::right ? padding + cell : cell + padding);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      if (!line.empty()) text += line + '\n';
    }
  }
  return text;
}

std::string Table::text(int indent, int width) const {
  std::vector<int> widths = natural_widths();
  std::vector<std::size_t> all(columns_.size());
  std::iota(all.begin(), all.end(), 0U);
  if (keys_ == 0) narrow(widths, width - indent);
  if (total_width(widths) <= width - indent || columns_.size() < 3) return block(indent, width, widths, all);
  const std::size_t key_count = std::max<std::size_t>(keys_, 1);
  const std::vector<std::size_t> keys(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(key_count));
  std::string text;
  for (std::size_t next = key_count; next < all.size();) {
    std::vector<std::size_t> columns = keys;
    int used = indent - kColumnGap;
    for (const std::size_t key : keys) used += widths[key] + kColumnGap;
    do {
      used += widths[next] + kColumnGap;
      columns.push_back(next++);
    } while (next < all.size() && used + kColumnGap + widths[next] <= width);
    text += (text.empty() ? "" : "\n") + block(indent, width, widened(widths, columns, width - indent), columns);
  }
  return text;
}

std::string constants_text(const std::vector<std::string>& constants, int width) {
  if (constants.empty()) return {};
  std::string text = "The same in all rows: ";
  for (const std::string& constant : constants) text += (&constant == &constants.front() ? "" : "; ") + constant;
  return '\n' + wrapped(text, width, "", "  ");
}

}  // namespace cellcrush::client
