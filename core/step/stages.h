#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "step/step_record.h"
#include "step/workspace.h"

namespace cellcrush {

// The stages of a step for one band of the lattice, which is all of a small one. advance_step goes through the bands
// stage by stage, advance_block band by band.

/// Moves a band's free particles and clears the contact forces that moved them.
void move_band(const Scene& scene, State& state, std::size_t band, StepRecord& record, StageWorkspace& workspace,
               std::vector<int>& near_plates);

/// The walls' forces on a band's particles. REQUIRES: the bands before have been evaluated.
void evaluate_band_walls(const Scene& scene, State& state, std::size_t band, StepRecord& record,
                         StageWorkspace& workspace);

/// The contacts' forces on a band's balls and on what they touch. REQUIRES: find_contacts, and the bands before.
void evaluate_band_contacts(const Scene& scene, State& state, std::size_t band, StepRecord& record,
                            StageWorkspace& workspace);

/// The plates' forces on a band's particles.
void evaluate_band_plates(const Scene& scene, State& state, std::size_t band, StepRecord& record,
                          const std::vector<int>& near_plates);

}  // namespace cellcrush
