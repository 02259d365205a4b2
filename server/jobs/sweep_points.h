#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::jobs {

/// Maximum number of points in a sweep.
inline constexpr std::size_t kMostPoints = 100'000;

/// The parameters that a sweep varies.
struct SweepPoints {
  std::vector<std::string> fields;
  std::vector<std::vector<double>> values;  ///< by point: one value per field, in the order of `fields`
};

/// Points that equal an earlier one: their number, and the first of them with the point it equals, as indices.
struct RepeatedPoints {
  std::size_t count = 0;
  std::size_t first = 0;
  std::size_t second = 0;
};
RepeatedPoints find_repeated(const std::vector<std::vector<double>>& points);

/// At least as many points as the sweep has, and at most kMostPoints, without making them.
std::int64_t most_points(const v1::Sweep& sweep);

/// All points of a sweep: either every combination of its axes' values, the last axis varying fastest, where axes that
/// advance together count as one, or its explicit points. Throws InvalidField if axes or points are invalid, or exceed
/// kMostPoints.
SweepPoints expand(const v1::Sweep& sweep);

}  // namespace cellcrush::jobs
