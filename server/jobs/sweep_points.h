#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::jobs {

/// Points of one sweep, at most.
inline constexpr std::size_t kMostPoints = 10'000;

/// What a sweep varies.
struct SweepPoints {
  std::vector<std::string> fields;
  std::vector<std::vector<double>> values;  ///< of each point: a value a field, in the order of `fields`
};

/// The fields that a sweep varies: its axes in their order, or those of its points in the order of their names.
std::vector<std::string> swept_fields(const v1::Sweep& sweep);

/// All points of a sweep: every combination of its axes' values, the last axis changing fastest, or the points it
/// names. Throws InvalidField when axes and points are not what they must be, or are more than kMostPoints.
SweepPoints expand(const v1::Sweep& sweep);

}  // namespace cellcrush::jobs
