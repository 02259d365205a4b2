#pragma once

#include <map>
#include <string>
#include <vector>

namespace cellcrush::bench {

/// A row of a CSV file by the names of its first line.
using CsvRow = std::map<std::string, std::string>;

/// The rows of a CSV file without quotes; none when there is no such file. Throws std::invalid_argument, with file and
/// line, on a row that has not as many cells as the first line.
std::vector<CsvRow> read_csv(const std::string& file);

/// A cell as a number; not a number when it is empty or none. Throws std::out_of_range, with its name, when there is no
/// such cell.
double number_in(const CsvRow& row, const std::string& name);

}  // namespace cellcrush::bench
