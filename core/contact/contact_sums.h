#pragma once

#include <vector>

#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// Sums over the contacts of a step. Their forces are summed in the order of balls, band by band.
struct ContactSums {
  ContactTotals walls;
  PlateForce impact;
  PlateForce support;
  std::vector<RigidWallForce> rigid_walls;
  /// Pairs with balls of the next band, found in a face that this band searches.
  std::vector<NewContact> of_next_band;
};

/// The sums at the start of a step.
inline ContactSums begin_contact_sums(const State& state) {
  ContactSums sums;
  sums.walls.deepest_penetration = state.contact_totals.deepest_penetration;
  sums.walls.deepest_birth = state.contact_totals.deepest_birth;
  sums.rigid_walls.resize(state.rigid_wall_force.size());
  return sums;
}

/// Stores the sums of the newest step in the state.
inline void put_contact_sums(const ContactSums& sums, State& state) {
  state.contact_totals = sums.walls;
  state.impact_force = sums.impact;
  state.support_force = sums.support;
  state.rigid_wall_force = sums.rigid_walls;
}

}  // namespace cellcrush
