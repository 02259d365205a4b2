#pragma once

#include "cellcrush/scene_spec.h"
#include "scene/mesh_part.h"
#include "scene/run_plan.h"

namespace cellcrush {

/// Time of a run on one core, as so many element-steps of the reference crush: the preset `hexagon-small` at 20 m/s
/// without samples. An element-step takes
///   c = elastic + flowing V^2 / (V^2 + V_f^2),  V_f = 0.49 sqrt(sigma_y / rho)
/// of one of the reference: a section that yields costs more, and in fast crushes more of them yield in a step. V
/// is the speed of the plates, or half of the greatest one of other loads (approach_speed_of). Each step, and each
/// sample, has a constant time beside. The factors are fitted to runs of presets and lattices of 300 to 10,000
/// elements; tests/load/README.md says how far they hold. A run that ends at rest is predicted up to its end time.
/// REQUIRES: the fidelity has been filled in; a plan without problems.
double reference_steps(const SceneSpec& spec, const MeshMeasures& mesh, const RunPlan& plan);

}  // namespace cellcrush
