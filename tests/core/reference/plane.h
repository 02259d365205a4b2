#pragma once

#include <Eigen/Core>

namespace cellcrush::reference {

using Vector = Eigen::Vector2d;

inline double cross(const Vector& a, const Vector& b) { return a.x() * b.y() - a.y() * b.x(); }
inline Vector turned_left(const Vector& a) { return {-a.y(), a.x()}; }
inline Vector turned_right(const Vector& a) { return {a.y(), -a.x()}; }

}  // namespace cellcrush::reference
