#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/scene_spec.h"

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

  /// Requires a finite value within the limits of the field, which field_limits.inc has from case.proto. `note` follows
  /// limits and unit in the remedy. Throws std::logic_error if the file lacks the field, as greatest_of does.
  bool within_limits(const std::string& field, std::optional<double> value, const std::string& note = "");

  /// The upper limit of a field in field_limits.inc.
  static double greatest_of(const std::string& field);

  /// Requires points with finite values and ascending times, in `field`.points.
  void is_function_of_time(const std::string& field, const std::vector<std::pair<double, double>>& points);

  void add(const std::string& field, const std::string& value, const std::string& message, const std::string& remedy);

  [[nodiscard]] bool is_empty() const { return problems_.empty(); }

  Problems take() { return std::move(problems_); }

 private:
  Problems problems_;
};

/// What follows a range that ends at a share of a side.
std::string unit_of_share(double share, double side);

}  // namespace cellcrush
