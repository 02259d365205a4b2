#pragma once

#include <span>

#include "step/stages.h"

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

/// Runs stages on the whole lattice, in their order. Adjacent stages that have no function for the whole are run band
/// by band, so that forces are added in the order of bands. With two threads and up to kMostElementsOverlapped
/// elements, the stages that follow a split one and may run beside its pieces do (runs_beside).
void execute_stages(std::span<const StageEntry> stages, StepInProgress& step, const StageScope& scope);

/// Runs the stages of a wavefront at one place: each on the band `bands_behind` before it, if there is such a band.
void execute_band_stages(std::span<const StageEntry> stages, StepInProgress& step, std::size_t band,
                         const StageScope& scope);

}  // namespace cellcrush
