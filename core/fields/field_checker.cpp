#include "fields/field_checker.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace cellcrush {
namespace {

constexpr double kLargest = 1e12;  // shown as no limit

struct FieldLimits {
  std::string_view path;
  FieldChecker::Range range;
  std::string_view unit;
};

constexpr FieldLimits kLimits[] = {
#include "fields/field_limits.inc"
};
static_assert(std::ranges::is_sorted(kLimits, {}, &FieldLimits::path));

/// The limits of a field at `path`, which may have indices in brackets.
const FieldLimits& limits_of(std::string path) {
  for (std::size_t open = path.find('['); open != std::string::npos; open = path.find('[')) {
    path.erase(open, path.find(']', open) + 1 - open);
  }
  const auto found = std::ranges::lower_bound(kLimits, std::string_view(path), {}, &FieldLimits::path);
  if (found == std::end(kLimits) || found->path != path) {
    throw std::logic_error("The solver checks " + path + ", but case.proto gives it no minimum and maximum.");
  }
  return *found;
}

std::string describe(const FieldChecker::Range& range) {
  return range.high >= kLargest
             ? "of at least " + to_text(range.low)
             : "from " + to_text(range.low) + (range.high_open ? " to below " : " to ") + to_text(range.high);
}

}  // namespace

std::string to_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string unit_of_share(double share, double side) {
  return std::isfinite(side) ? " mm (" + (share == 0.5 ? "half" : to_text(share)) + " of side_mm)" : " mm";
}

bool FieldChecker::in_range(const std::string& field, std::optional<double> value, Range range,
                            const std::string& unit) {
  const char* wrong = nullptr;
  if (!value) {
    wrong = "is missing.";
  } else if (!std::isfinite(*value)) {
    wrong = "is not a finite number.";
  } else if (*value < range.low) {
    wrong = "is too small.";
  } else if (range.high_open ? *value >= range.high : *value > range.high) {
    wrong = "is too large.";
  }
  if (wrong != nullptr) {
    add(field, value ? to_text(*value) : "", wrong, "Give a value " + describe(range) + unit + ".");
  }
  return wrong == nullptr;
}

bool FieldChecker::within_limits(const std::string& field, std::optional<double> value, const std::string& note) {
  const FieldLimits& limits = limits_of(field);
  return in_range(field, value, limits.range, std::string(limits.unit) + note);
}

void FieldChecker::is_function_of_time(const std::string& field, const std::vector<std::pair<double, double>>& points) {
  const bool finite = std::ranges::all_of(
      points, [](const auto& point) { return std::isfinite(point.first) && std::isfinite(point.second); });
  const auto descent =
      std::ranges::adjacent_find(points, std::greater_equal(), [](const auto& point) { return point.first; });
  if (points.empty() || !finite || descent != points.end()) {
    add(field + ".points", "", "do not define a function of time.",
        "Give at least one point, with finite values and ascending times.");
  }
}

void FieldChecker::add(const std::string& field, const std::string& value, const std::string& message,
                       const std::string& remedy) {
  problems_.push_back({field, value, message, remedy});
}

double FieldChecker::greatest_of(const std::string& field) { return limits_of(field).range.high; }

}  // namespace cellcrush
