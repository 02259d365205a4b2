#pragma once

#include <vector>

#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// What the contacts of a step come to. Their forces are summed in the order of balls, band by band.
struct ContactSums {
  ContactTotals walls;
  PlateForce impact;
  PlateForce support;
  std::vector<NewContact> of_next_band;  ///< pairs of its balls, found in a face that the band before searches
};

/// Those of a new step.
inline ContactSums begin_contact_sums(const State& state) {
  ContactSums sums;
  sums.walls.deepest_penetration = state.contact_totals.deepest_penetration;
  sums.walls.deepest_birth = state.contact_totals.deepest_birth;
  return sums;
}

/// Those of the newest step go into the state.
inline void put_contact_sums(const ContactSums& sums, State& state) {
  state.contact_totals = sums.walls;
  state.impact_force = sums.impact;
  state.support_force = sums.support;
}

}  // namespace cellcrush
