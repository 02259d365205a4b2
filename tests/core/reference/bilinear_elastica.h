#pragma once

namespace cellcrush::reference {

/// Rectangular section of a bilinear material without axial force.
struct BilinearSection {
  double thickness = 0.0;  ///< h, mm; the depth is 1 mm
  double modulus = 0.0;    ///< E, MPa
  double tangent = 0.0;    ///< E_T, MPa
  double yield_stress = 0.0;

  /// Curvature under a moment that has never been larger, 1/mm: the inverse of
  /// M = (1 - E_T/E) M_e (1.5 - 0.5 (k_e/k)^2) + E_T I k beyond the elastic limit k_e.
  [[nodiscard]] double curvature(double moment) const;
};

/// Load in N under which the upper end of an inextensible wall, at `angle` to the horizontal and of fixed rotation at
/// both ends, has gone straight down by `way`. The wall's equations phi' = k(M), M' = F cos phi are integrated from its
/// middle, where M = 0, by Runge-Kutta steps of order 4, and shot for phi = angle at the end. Shares nothing with the
/// solver.
double load_of_pushed_wall(const BilinearSection& section, double length, double angle, double way);

}  // namespace cellcrush::reference
