#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// Greatest speed, mm/s, at which parts of a lattice can approach each other as far as its spec says (E9a):
///   V = max |v_i - v_j| + max |Omega| r + sqrt(2 max(g H, g_w D)).
/// v are all velocities that are given: those of the particles at the start, and those of imposed motions and rigid
/// walls at any time. Omega is the steepest slope of an imposed rotation; r is the greatest distance of its node from
/// the lattice's middle and of the middle from a particle, added. H is the extent of the lattice along gravity. g_w is
/// the component of gravity towards a rigid wall, and D the greatest distance of a particle from it. What loads
/// accelerate is not known beforehand. 0 where plates alone act.
double approach_speed_of(const Scene& scene);

}  // namespace cellcrush
