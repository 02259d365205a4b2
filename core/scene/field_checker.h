#pragma once

#include <optional>
#include <string>

#include "cellcrush/problem.h"

namespace cellcrush {

/// Collects problems field by field. Each call checks one field and returns whether it can be used.
class FieldChecker {
 public:
  struct Range {
    double low;
    double high;
    bool high_open = false;  ///< the high end itself is refused
  };

  /// Within the range and finite. `unit` follows the range in the remedy, such as " mm"; may be empty.
  bool in_range(const std::string& field, double value, Range range, const std::string& unit);
  /// The same for a field without default, reported when missing.
  bool in_range(const std::string& field, const std::optional<double>& value, Range range, const std::string& unit);
  bool in_range(const std::string& field, const std::optional<int>& value, Range range, const std::string& unit);

  /// A value above 0, neither absurdly small nor absurdly large.
  bool positive(const std::string& field, const std::optional<double>& value, const std::string& unit);

  void add(const std::string& field, const std::string& value, const std::string& message, const std::string& remedy);

  Problems take() { return std::move(problems_); }

 private:
  Problems problems_;
};

}  // namespace cellcrush
