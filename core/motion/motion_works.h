#pragma once

#include "cellcrush/state.h"

namespace cellcrush {

/// Works of the forces on particles, summed over particles, as the Ledger has them, N mm. Forces act at whole steps,
/// velocities stand half a step off: a force's work is F(t_n) . dt (v(n-1/2) + v(n+1/2)) / 2, the trapezoidal rule over
/// the displacements.
struct MotionWorks {
  double contact = 0.0;
  double contact_damping = 0.0;
  double friction = 0.0;
  double mass_damping = 0.0;
  double external = 0.0;       ///< of loads and of supports that move
  double twice_kinetic = 0.0;  ///< m v(n-1/2) . v(n+1/2), where it is asked for

  void add(const MotionWorks& other) {
    contact += other.contact;
    contact_damping += other.contact_damping;
    friction += other.friction;
    mass_damping += other.mass_damping;
    external += other.external;
    twice_kinetic += other.twice_kinetic;
  }

  void accumulate(Ledger& ledger) const {
    ledger.contact += contact;
    ledger.contact_damping += contact_damping;
    ledger.friction += friction;
    ledger.mass_damping += mass_damping;
    ledger.external += external;
  }
};

}  // namespace cellcrush
