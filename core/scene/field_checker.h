#pragma once

#include <optional>
#include <string>
#include <utility>

#include "cellcrush/problem.h"

namespace cellcrush {

/// A number as shown in problems: the shortest text that reads back as the same value.
std::string to_text(double value);

/// Collects problems field by field. Each call checks one field and returns whether its value is valid.
class FieldChecker {
 public:
  struct Range {
    double low;
    double high;
    bool high_open = false;  ///< the upper limit itself is refused
  };

  /// Requires a finite value within the range. `unit`, such as " mm", follows the range in the remedy.
  bool in_range(const std::string& field, std::optional<double> value, Range range, const std::string& unit = "");

  /// Requires a value above 0 that is neither absurdly small nor absurdly large.
  bool positive(const std::string& field, std::optional<double> value, const std::string& unit);

  void add(const std::string& field, const std::string& value, const std::string& message, const std::string& remedy);

  Problems take() { return std::move(problems_); }

 private:
  Problems problems_;
};

/// What follows a range that ends at half of a side.
std::string half_of_side(double side);

}  // namespace cellcrush
