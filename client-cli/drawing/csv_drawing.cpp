#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>

#include "drawing/drawing.h"

// Tables of walls: x1, y1, x2, y2, and optionally thickness and rise; or of nodes (id, x, y) and edges (start, end).
namespace cellcrush::drawing {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

/// Rows of a file by the names of its first line.
class CsvTable {
 public:
  CsvTable(const std::string& text, std::string file) : file_(std::move(file)) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      ++line_count_;
      if (trimmed(line).empty() || line.front() == '#') continue;
      const std::vector<std::string> cells = cells_of(line);
      if (names_.empty()) {
        names_ = cells;
        continue;
      }
      if (cells.size() != names_.size()) {
        refuse(fmt::format("{}:{}: has {} cells, and the first line {}. Give each row one cell for each name.", file_,
                           line_count_, cells.size(), names_.size()));
      }
      rows_.push_back({line_count_, cells});
    }
  }

  [[nodiscard]] bool has(const std::string& name) const { return std::ranges::find(names_, name) != names_.end(); }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] std::string place(std::size_t row) const { return fmt::format("line {}", rows_[row].line); }

  [[nodiscard]] std::string text(std::size_t row, const std::string& name) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) {
      refuse(
          fmt::format("{}: has no column {}. Give a first line with x1,y1,x2,y2, or with id,x,y for nodes and "
                      "start,end for edges; thickness and rise may follow.",
                      file_, name));
    }
    return rows_[row].cells[found - names_.begin()];
  }

  [[nodiscard]] double number(std::size_t row, const std::string& name) const {
    const std::string cell = text(row, name);
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) {
      refuse(fmt::format("{}:{}: {} is \"{}\", which is no number.", file_, rows_[row].line, name, cell));
    }
    return value;
  }

  /// What a column that may be missing, or have empty cells, says of a wall.
  [[nodiscard]] std::optional<double> number_if_any(std::size_t row, const std::string& name) const {
    if (!has(name) || text(row, name).empty()) return std::nullopt;
    return number(row, name);
  }

 private:
  struct Row {
    int line;
    std::vector<std::string> cells;
  };

  static std::vector<std::string> cells_of(const std::string& line) {
    const char separator = line.find(',') != std::string::npos ? ',' : line.find(';') != std::string::npos ? ';' : '\t';
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, separator);) cells.push_back(trimmed(cell));
    if (!line.empty() && line.back() == separator) cells.emplace_back();
    return cells;
  }

  std::string file_;
  int line_count_ = 0;
  std::vector<std::string> names_;
  std::vector<Row> rows_;
};

void add_properties(const CsvTable& table, std::size_t row, DrawnWall& wall) {
  wall.thickness = table.number_if_any(row, "thickness");
  wall.rise = table.number_if_any(row, "rise").value_or(0.0);
  wall.name = table.place(row);
}

}  // namespace

Drawing read_csv_drawing(const std::string& text, const std::string& file) {
  const CsvTable table(text, file);
  Drawing drawing;
  for (std::size_t row = 0; row < table.size(); ++row) {
    DrawnWall& wall = drawing.walls.emplace_back();
    wall.start = {table.number(row, "x1"), table.number(row, "y1")};
    wall.end = {table.number(row, "x2"), table.number(row, "y2")};
    add_properties(table, row, wall);
  }
  return drawing;
}

Drawing read_csv_drawing(const std::string& nodes, const std::string& nodes_file, const std::string& edges,
                         const std::string& edges_file) {
  const CsvTable places(nodes, nodes_file);
  std::map<std::string, DrawnPlace> by_id;
  for (std::size_t row = 0; row < places.size(); ++row) {
    by_id[places.text(row, "id")] = {places.number(row, "x"), places.number(row, "y")};
  }
  const CsvTable table(edges, edges_file);
  Drawing drawing;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const auto place_of = [&](const char* name) {
      const auto found = by_id.find(table.text(row, name));
      if (found == by_id.end()) {
        refuse(fmt::format("{}: {}: {} is \"{}\", which is no id in {}.", edges_file, table.place(row), name,
                           table.text(row, name), nodes_file));
      }
      return found->second;
    };
    DrawnWall& wall = drawing.walls.emplace_back();
    wall.start = place_of("start");
    wall.end = place_of("end");
    add_properties(table, row, wall);
  }
  return drawing;
}

}  // namespace cellcrush::drawing
