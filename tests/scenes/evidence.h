#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace cellcrush::scenes {

// What the tests measured, for the tables of tests/core/README.md. The record is tests/core/evidence.csv. A test holds
// each value that it measures against its row, and fails without one. With CELLCRUSH_WRITE_EVIDENCE set it writes the
// row instead.

/// Recorded values as they stand in the page, by the test (Suite.Name, without parameters) and the quantity.
using Evidence = std::map<std::pair<std::string, std::string>, std::string>;

/// Throws std::invalid_argument, with file and line, on a row that is not test,quantity,value.
Evidence read_evidence(const std::filesystem::path& file);

/// Throws std::runtime_error if the file cannot be written.
void write_evidence(const std::filesystem::path& file, const Evidence& evidence);

/// What a figure must be, whatever is recorded.
struct Expected {
  double value = 0.0;
  double tolerance = std::numeric_limits<double>::infinity();
};

/// A figure with that many significant digits. Measured and recorded may differ by one unit of the last digit.
void record_figure(const std::string& quantity, double value, int digits, const Expected& expected = {});

/// An upper bound of a magnitude, rounded up to two digits: for what is near round-off or chaotic, and so differs among
/// processors. The measured magnitude may be up to 3 times as large. Writing never lowers a bound, so that the largest
/// of all parameters and kernels stays; to lower it, delete its row first. No bound is below 1e-14. Whatever the record
/// says, the magnitude must be less than `most`.
void record_bound(const std::string& quantity, double value, double most = std::numeric_limits<double>::infinity());

}  // namespace cellcrush::scenes
