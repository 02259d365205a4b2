#pragma once

#include <Eigen/Core>

namespace cellcrush {

/// A vector in the plane of the lattice.
using Vector2 = Eigen::Vector2d;

/// z component of the cross product: positive if `b` points counter-clockwise of `a`.
inline double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// `a` rotated by 90 degrees counter-clockwise.
inline Vector2 normal_of(const Vector2& a) { return {-a.y(), a.x()}; }

}  // namespace cellcrush
