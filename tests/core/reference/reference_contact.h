#pragma once

#include <vector>

#include "core/reference/reference_lattice.h"

namespace cellcrush::reference {

/// Particles at a time, with their velocities of half a step before.
struct Motion {
  std::vector<Vector> position;
  std::vector<Vector> velocity;
};

/// Forces of contacts and plates on the particles, N, and what they come to.
struct ContactForces {
  std::vector<Vector> elastic;
  std::vector<Vector> viscous;
  std::vector<Vector> friction;
  double impact_elastic = 0.0;  ///< of the impact plate on the lattice, along the crush
  double impact_viscous = 0.0;
  double support = 0.0;  ///< of the support plate on the lattice, against the crush
  double stored = 0.0;   ///< N mm (E8b), plates included
  int count = 0;         ///< touches of walls that push
};

/// History of a ball and a segment.
struct Pair {
  double reach = 0.0;     ///< mm, distance at which they touch before loading; 0 for a ball at an end of the segment
  double most = 0.0;      ///< mm, the greatest (E8a)
  int side = 0;           ///< of the segment, from which the ball came: +1 left, -1 right; 0: they do not touch
  bool rubs = false;      ///< whether their touch carried friction in the newest step
  double friction = 0.0;  ///< N, on the ball, along the normal turned right
};

/// Histories of every ball with every segment, segments innermost, before the first step.
std::vector<Pair> no_contact(const Lattice& lattice, const Particles& particles);

/// What the radius of a ball has grown by (E5f), mm, and the forces on the ends of the elements with which it grows, if
/// `force` presses against it (E8d).
double growth_of_ball(const Lattice& lattice, const Particles& particles, const Motion& motion, int ball);
void push_elements_apart(const Lattice& lattice, const Particles& particles, const Motion& motion, int ball,
                         double force, ContactForces& forces);

/// Adds the forces of the walls on each other (Eq. 41-47, E8, E8b, E9): every ball against every segment.
void push_walls(const Lattice& lattice, const Particles& particles, const Motion& motion, std::vector<Pair>& pairs,
                ContactForces& forces);

}  // namespace cellcrush::reference
