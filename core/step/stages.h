#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/stage.h"
#include "cellcrush/state.h"
#include "step/step_record.h"
#include "step/workspace.h"

namespace cellcrush {

/// Reports the stages of a step to an observer, if there is one.
class StageScope {
 public:
  explicit StageScope(StageObserver* observer) : observer_(observer) {}
  void begin(Stage stage) const {
    if (observer_ != nullptr) {
      observer_->begin(stage);
    }
  }
  void end_step() const {
    if (observer_ != nullptr) {
      observer_->end_step();
    }
  }

 private:
  StageObserver* observer_;
};

// The stages of a step for one band of the lattice; a small lattice is a single band. advance_step does all bands stage
// by stage, advance_wavefront does all stages band by band.

/// Moves the free particles of a band (E2) and clears the contact forces that moved them.
void move_band(const Scene& scene, State& state, std::size_t band, StepRecord& record, StageWorkspace& workspace,
               std::vector<int>& near_plates);

/// Evaluates the forces of the walls on the particles of a band (E3 to E7). REQUIRES: earlier bands have been
/// evaluated.
void evaluate_band_walls(const Scene& scene, State& state, std::size_t band, StepRecord& record,
                         StageWorkspace& workspace);

/// Evaluates the contact forces on the balls of a band and on the segments that they touch (E8 to E9e). REQUIRES:
/// find_contacts, and earlier bands have been evaluated.
void evaluate_band_contacts(const Scene& scene, State& state, std::size_t band, StepRecord& record,
                            StageWorkspace& workspace);

/// Evaluates the forces of the plates and rigid walls on the particles of a band (E9c to E9f).
void evaluate_band_plates(const Scene& scene, State& state, std::size_t band, StepRecord& record,
                          const std::vector<int>& near_plates);

}  // namespace cellcrush
