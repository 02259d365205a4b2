#pragma once

#include <optional>
#include <string>

#include "cellcrush/problem.h"

namespace cellcrush {

/// Collects problems field by field. Each call checks one field and returns whether its value is valid.
class FieldChecker {
 public:
  struct Range {
    double low;
    double high;
    bool high_open = false;  ///< the upper limit itself is refused
  };

  /// Requires a finite value within the range. `unit`, such as " mm", follows the range in the remedy; it may be empty.
  bool in_range(const std::string& field, double value, Range range, const std::string& unit);
  /// The same for a field without a default; reported if missing.
  bool in_range(const std::string& field, const std::optional<double>& value, Range range, const std::string& unit);
  bool in_range(const std::string& field, const std::optional<int>& value, Range range, const std::string& unit);

  /// Requires a value above 0 that is neither absurdly small nor absurdly large.
  bool positive(const std::string& field, const std::optional<double>& value, const std::string& unit);

  void add(const std::string& field, const std::string& value, const std::string& message, const std::string& remedy);

  Problems take() { return std::move(problems_); }

 private:
  Problems problems_;
};

}  // namespace cellcrush
