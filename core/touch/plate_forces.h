#pragma once

#include <span>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// Positions along the crush between which no ball reaches a plate, mm.
struct PlateReach {
  double below = 0.0;  ///< below it a ball may reach the impact plate
  double above = 0.0;  ///< above it a ball may reach the support plate
};

/// The range for an impact plate that has travelled so far. Without plates, no position is outside it.
PlateReach reach_of_plates(const Scene& scene, double impact_travel);

/// Travel and speed of the impact plate.
struct PlateMotion {
  double impact_travel = 0.0;  ///< mm
  double impact_speed = 0.0;   ///< mm/s, half a step before
};

/// Adds the forces of the rigid, unilateral plates on particles whose balls overlap them, by the penalty law of the
/// walls (E9c), to contact_force and to the sums. Forces are positive in compression: the impact plate pushes along the
/// crush, the support plate against it. Friction acts across the crush on the surfaces of the balls (E9d). It is added
/// to friction_force, also of the particles beside them. Only the particles `near`, ascending, are tested: they include
/// all that may reach a plate or that have friction at one.
void evaluate_plate_forces(const Scene& scene, State& state, const PlateMotion& motion, std::span<const int> near,
                           ContactSums& sums);

}  // namespace cellcrush
