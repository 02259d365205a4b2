#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Takes samples of a run. Stresses are means over the interval between two samples, from the plates' impulses: a penalty
/// contact rings, and the force at one moment says little.
class Sampler {
 public:
  Sample take(const Scene& scene, const State& state);

 private:
  double last_time_ = 0.0;
  double last_impact_impulse_ = 0.0;
  double last_support_impulse_ = 0.0;
};

/// Positions, and the share of each element's section area that has yielded.
FieldFrame make_frame(const Scene& scene, const State& state, int index);

}  // namespace cellcrush
