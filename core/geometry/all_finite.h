#pragma once

#include <Eigen/Core>
#include <span>

#include "cellcrush/vector.h"

namespace cellcrush {

/// Whether all numbers are finite. Only a non-finite number keeps the sum of the products with 0 from being 0.
inline bool all_finite(std::span<const double> numbers) {
  return (0.0 * Eigen::Map<const Eigen::ArrayXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()))).sum() ==
         0.0;
}

inline bool all_finite(std::span<const Vector2> points) {
  return points.empty() || all_finite({points.front().data(), 2 * points.size()});
}

}  // namespace cellcrush
