#pragma once

#include <vector>

#include "core/reference/reference_contact.h"
#include "core/reference/reference_lattice.h"

namespace cellcrush::reference {

/// Friction of the plates on every particle in the newest step, N, across the crush.
struct PlateHistory {
  std::vector<double> impact_friction;
  std::vector<double> support_friction;
};

/// Adds the forces of the plates on every particle (Eq. 43-47, E9). The impact plate has come by `travel` (mm); its
/// speed is that of half a step before.
void push_plates(const Lattice& lattice, const Particles& particles, const Motion& motion, double travel, double speed,
                 PlateHistory& history, ContactForces& forces);

}  // namespace cellcrush::reference
