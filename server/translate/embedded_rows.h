#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace cellcrush::translate {

/// The cells of a line of an embedded CSV file, from the first on. None of them is quoted.
class Cells {
 public:
  explicit Cells(const std::string& line) : line_(line) {}

  std::string text() {
    std::string cell;
    std::getline(line_, cell, ',');
    return cell;
  }
  double number() { return std::stod(text()); }
  int count() { return std::stoi(text()); }

 private:
  std::istringstream line_;
};

/// The rows of an embedded CSV file below the names of its columns, as read(cells) gives them.
template <class Row>
std::vector<Row> rows_of(const char* file, Row (*read)(Cells&)) {
  std::vector<Row> rows;
  std::istringstream lines(file);
  std::string line;
  std::getline(lines, line);  // the names of the columns
  while (std::getline(lines, line)) {
    Cells cells(line);
    rows.push_back(read(cells));
  }
  return rows;
}

}  // namespace cellcrush::translate
