#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// What the impact plate does over a step, whatever the lattice does.
struct PlateStep {
  double displacement = 0.0;  ///< mm, over the time of the forces' work: half a step before and half a step after them
  double travel = 0.0;        ///< mm, at the step's end
};
PlateStep plate_step_of(const Scene& scene, double time, double travel);

/// Adds the work of the impact plate's forces over a mean displacement, mm, to the ledger. On the particles' side its
/// forces are among the contacts'.
void accumulate_plate_work(const State& state, double displacement, Ledger& ledger);

/// Accumulates the work and the impulses of the plates' forces over a step, and moves the impact plate.
void accumulate_plates(const Scene& scene, const PlateStep& plates, State& state);

}  // namespace cellcrush
