#pragma once

#include "core/scene/unit_cell.h"

namespace cellcrush {

/// What an endless lattice of elastic beams answers to a uniform stress along an axis.
struct CellModuli {
  double modulus = 0.0;  ///< over E
  double poissons_ratio = 0.0;
};

/// Solves a unit cell as straight Euler-Bernoulli beams with periodic displacements.
CellModuli solve_periodic_cell(const UnitCell& cell, int axis);

/// The uniform stress along an axis, over sigma_y, at which a unit cell of elastic, perfectly plastic beams becomes a
/// mechanism: its parts yield one by one, by a force of t or a moment of t^2/4, until its stiffness has fallen to a
/// thousandth. Displacements stay small; force and moment do not weaken each other.
double collapse_stress_of_periodic_cell(const UnitCell& cell, int axis);

}  // namespace cellcrush
