#include "bench/csv_table.h"

#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace cellcrush::bench {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char letter : line) {
    if (letter == ',') {
      cells.emplace_back();
    } else {
      cells.back() += letter;
    }
  }
  return cells;
}

}  // namespace

std::vector<CsvRow> read_csv(const std::string& file) {
  std::ifstream stream(file);
  std::vector<CsvRow> rows;
  std::string line;
  if (!std::getline(stream, line)) return rows;
  const std::vector<std::string> names = cells_of(line);
  for (int number = 2; std::getline(stream, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != names.size()) {
      throw std::invalid_argument(file + ":" + std::to_string(number) + ": has " + std::to_string(cells.size()) +
                                  " cells where the first line has " + std::to_string(names.size()) +
                                  "; remove the line.");
    }
    CsvRow row;
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = cells[i];
    rows.push_back(std::move(row));
  }
  return rows;
}

double number_in(const CsvRow& row, const std::string& name) {
  const auto found = row.find(name);
  if (found == row.end()) throw std::out_of_range("The table has no column " + name + "; give one of work_precision.");
  char* end = nullptr;
  const double value = std::strtod(found->second.c_str(), &end);
  return end == found->second.c_str() ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace cellcrush::bench
