#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "measure/collapse.h"
#include "measure/columns.h"

namespace cellcrush {

/// Takes samples of a run. Stresses are means over the interval between two samples, from the plates' impulses: a
/// penalty contact rings, and the force at one moment says little. Collapse and front are read from the positions and
/// velocities of now. Only a lattice between plates has cells, columns and a front.
class Sampler {
 public:
  explicit Sampler(const Scene& scene);

  /// REQUIRES: `scene` is that of the constructor.
  Sample take(const Scene& scene, const State& state);

  /// Calls visitor(field) for all that a sample leaves for the next one.
  template <class Visitor>
  void visit_memory(Visitor&& visitor) {
    visitor(last_time_);
    visitor(last_impact_impulse_);
    visitor(last_support_impulse_);
    visitor(told_of_depth_);
    visitor(told_of_search_);
    visitor(next_look_);
  }

 private:
  void measure_stress(const Scene& scene, const State& state, Sample& sample);
  void measure_collapse(const Scene& scene, const State& state, Sample& sample);
  void find_warnings(const Scene& scene, const State& state, Sample& sample);

  Cells cells_;
  Columns columns_;
  double relative_density_ = 0.0;
  double last_time_ = 0.0;
  double last_impact_impulse_ = 0.0;
  double last_support_impulse_ = 0.0;
  bool told_of_depth_ = false;
  bool told_of_search_ = false;
  double next_look_;  ///< share of collapsed cells from which the crush mode is looked for next
};

/// Overwrites a frame, of the same scene if of any: positions, and the share of each element's section area that has
/// yielded.
void make_frame(const Scene& scene, const State& state, int index, FieldFrame& frame);

}  // namespace cellcrush
