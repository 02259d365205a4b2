#include "scene/field_checker.h"

#include <cmath>

#include "scene/check_spec.h"

namespace cellcrush {
namespace {

constexpr double kLargest = 1e12;
constexpr double kSmallest = 1e-6;  // far below anything real, far above where squares underflow

std::string describe(const FieldChecker::Range& range, const std::string& unit) {
  if (range.high >= kLargest) {
    return std::string("of at least ") + to_text(range.low) + unit;
  }
  return std::string("from ") + to_text(range.low) + (range.high_open ? " to below " : " to ") + to_text(range.high) +
         unit;
}

}  // namespace

bool FieldChecker::in_range(const std::string& field, double value, Range range, const std::string& unit) {
  const std::string remedy = "Give a value " + describe(range, unit) + ".";
  if (!std::isfinite(value)) {
    add(field, to_text(value), "is not a finite number.", remedy);
    return false;
  }
  const bool too_low = value < range.low;
  const bool too_high = range.high_open ? value >= range.high : value > range.high;
  if (too_low || too_high) {
    add(field, to_text(value), too_low ? "is too small." : "is too large.", remedy);
    return false;
  }
  return true;
}

bool FieldChecker::in_range(const std::string& field, const std::optional<double>& value, Range range,
                            const std::string& unit) {
  if (!value) {
    add(field, "", "is missing.", "Give a value " + describe(range, unit) + ".");
    return false;
  }
  return in_range(field, *value, range, unit);
}

bool FieldChecker::in_range(const std::string& field, const std::optional<int>& value, Range range,
                            const std::string& unit) {
  return in_range(field, value ? std::optional<double>(*value) : std::nullopt, range, unit);
}

bool FieldChecker::positive(const std::string& field, const std::optional<double>& value, const std::string& unit) {
  return in_range(field, value, {kSmallest, kLargest}, unit);
}

void FieldChecker::add(const std::string& field, const std::string& value, const std::string& message,
                       const std::string& remedy) {
  problems_.push_back({field, value, message, remedy});
}

}  // namespace cellcrush
