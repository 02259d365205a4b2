#pragma once

#include <vector>

namespace cellcrush::reference {

/// Metal in plane strain: linear isotropic hardening of Mises' yield stress; its small elastic strains turn with it.
struct SolidMetal {
  double youngs_modulus = 0.0;  ///< MPa
  double poissons_ratio = 0.0;
  double yield_stress = 0.0;       ///< MPa
  double hardening_modulus = 0.0;  ///< MPa, over the plastic strain
};

/// An end of an arc, clamped, and moved evenly.
struct SolidEnd {
  double angle = 0.0;     ///< degrees about the centre, counter-clockwise from x: whole multiples of 90
  double motion_x = 0.0;  ///< mm
  double motion_y = 0.0;
};

/// An arc of a ring of unit depth. Its outer surface touches those of other arcs.
struct SolidArc {
  double centre_x = 0.0;  ///< mm
  double centre_y = 0.0;
  double inner = 0.0;  ///< mm, radius
  double outer = 0.0;
  SolidEnd first;
  SolidEnd last;  ///< at a greater angle
};

/// How arcs are divided and moved.
struct SolidRun {
  int across = 4;         ///< elements through the thickness
  double speed = 5e-4;    ///< of the fastest end, over that of sound
  double friction = 0.0;  ///< Coulomb's coefficient
};

/// Force on the ends of the first arc that stand still, N.
struct SolidForce {
  double share = 0.0;  ///< of the motion
  double x = 0.0;
  double y = 0.0;
};

/// Moves arcs slowly, as solids of square elements with four nodes, four stresses and one pressure each, by central
/// differences. Shares no code with the solver.
std::vector<SolidForce> move_arcs(const std::vector<SolidArc>& arcs, const SolidMetal& metal, const SolidRun& run);

}  // namespace cellcrush::reference
