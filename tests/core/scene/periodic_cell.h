#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// What an endless lattice of elastic beams answers to a uniform stress along an axis.
struct CellModuli {
  double modulus = 0.0;  ///< over E
  double poissons_ratio = 0.0;
};

/// Finds the unit cell that repeats in the middle of a scene, and solves it as straight Euler-Bernoulli beams with
/// periodic displacements. Shares nothing with the solver but positions, elements and thicknesses.
/// REQUIRES: one lattice without imperfection, at least eight cells wide and high.
CellModuli solve_periodic_cell(const Scene& scene, int axis);

}  // namespace cellcrush
