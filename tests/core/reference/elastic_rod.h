#pragma once

#include <Eigen/Dense>
#include <vector>

namespace cellcrush::reference {

/// An elastic rod in the plane that bends and stretches without limit, without shear (Euler's elastica with extension;
/// Antman 1995, chapter IV): turn' = curvature + M / EI, r' = (1 + n . t / EA) t, M' = -r' x n. It begins at the
/// origin. Integrated by Runge-Kutta steps of order 4. Shares nothing with the solver. Units mm, N.
struct ElasticRod {
  double length = 0.0;
  double bending = 0.0;     ///< EI, N mm^2
  double stretching = 0.0;  ///< EA, N
  double angle = 0.0;       ///< of its tangent at the start, where it is clamped
  double curvature = 0.0;   ///< before loading, 1/mm

  /// Where the rod has its middle and its end when its first section bears the force `n` and the moment, both as the
  /// rest of the rod exerts them on the clamp, and a load acts on its middle.
  struct Shape {
    Eigen::Vector2d middle;
    Eigen::Vector2d end;
    double end_angle = 0.0;
    double end_moment = 0.0;
  };
  [[nodiscard]] Shape shape_under(const Eigen::Vector2d& n, double moment, const Eigen::Vector2d& load) const;
};

/// Downward force on the apex of Williams's toggle for each downward motion of it, ascending: two rods that are joined
/// rigidly at the apex and clamped at the feet, of which `rod` is the left.
std::vector<double> toggle_loads(const ElasticRod& rod, const std::vector<double>& deflections);

/// Downward force on the middle of an arch for each downward motion of it, ascending from 0: clamped at its start,
/// hinged at its end. Shot by Newton's method from one deflection to the next.
std::vector<double> arch_loads(const ElasticRod& arch, const std::vector<double>& deflections);

}  // namespace cellcrush::reference
