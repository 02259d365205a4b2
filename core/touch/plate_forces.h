#pragma once

#include <span>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_sums.h"

namespace cellcrush {

/// Places along the crush from which no ball reaches a plate, mm.
struct PlateReach {
  double below = 0.0;  ///< nearer to the impact plate, one may
  double above = 0.0;  ///< nearer to the support plate, one may
};

/// Of the plates when the impact plate has travelled so far; beyond all places where there are none.
PlateReach reach_of_plates(const Scene& scene, double impact_travel);

/// How the impact plate is and moves.
struct PlateMotion {
  double impact_travel = 0.0;  ///< mm
  double impact_speed = 0.0;   ///< mm/s, half a step before
};

/// Adds the forces of the rigid, unilateral plates on particles whose balls reach into them, by the penalty law of the
/// walls, to contact_force and to the sums. Forces are positive in compression: the impact plate pushes along the
/// crush, the support plate against it. Friction acts across the crush; it is added to friction_force. Only the
/// particles `near`, ascending, are tested: all that may reach a plate, or that rub against one, are among them.
void evaluate_plate_forces(const Scene& scene, State& state, const PlateMotion& motion, std::span<const int> near,
                           ContactSums& sums);

}  // namespace cellcrush
