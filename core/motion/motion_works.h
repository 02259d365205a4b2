#pragma once

#include "cellcrush/state.h"

namespace cellcrush {

/// Works of the forces on particles, summed over the particles, in the terms of the Ledger, N mm (E10). Forces act at
/// whole steps, velocities at half steps. The work of a force is F(n) . dt [v(n-1/2) + v(n+1/2)] / 2, the trapezoidal
/// rule over the displacements.
struct MotionWorks {
  double contact = 0.0;
  double contact_damping = 0.0;
  double friction = 0.0;
  double mass_damping = 0.0;
  double external = 0.0;       ///< of loads and of moving supports
  double twice_kinetic = 0.0;  ///< m v(n-1/2) . v(n+1/2), where it is requested

  void add(const MotionWorks& other) {
    contact += other.contact;
    contact_damping += other.contact_damping;
    friction += other.friction;
    mass_damping += other.mass_damping;
    external += other.external;
    twice_kinetic += other.twice_kinetic;
  }

  constexpr void accumulate(Ledger& ledger, double factor = 1.0) const {
    ledger.contact += factor * contact;
    ledger.contact_damping += factor * contact_damping;
    ledger.friction += factor * friction;
    ledger.mass_damping += factor * mass_damping;
    ledger.external += factor * external;
  }
};

}  // namespace cellcrush
