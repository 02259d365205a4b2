#pragma once

#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "translate/check_case.h"
#include "translate/presets.h"

namespace cellcrush::translate {

/// Error that the mesh leaves in one quantity, measured over seeds of a small imperfection. Relative to the limit of
/// the measured meshes (estimate_convergence).
struct MeasuredError {
  std::string measure;       ///< the quantity, the preset and the speeds, in words
  double error = 0.0;        ///< of the mean
  double uncertainty = 0.0;  ///< half-width of the limit's interval; a smaller error is not significant
  double scatter = 0.0;      ///< standard deviation of one crush, relative to its mean
};

/// Fields that keep all measured errors from holding for a spec: those in which it differs from the specimen from which
/// it differs least. Empty if it is one of the specimens, or the same lattice with more cells; also with a smaller
/// imperfection, another mesh or an end past the plateau. Any other field counts, also one that the errors may not
/// depend on.
std::vector<std::string> fields_beside_measured(const SceneSpec& spec);

/// Errors of a spec that differs in no such field, with a mesh. Between two measured speeds the larger error counts.
std::vector<MeasuredError> measured_errors_of(const SceneSpec& spec, int elements_per_wall);

/// The preset of a kind of lattice with the most cells of those whose errors were measured; null if there is none.
const Preset* largest_measured(const std::string& kind);

/// Adds what a sound case would take and be worth at each fidelity to the answer of its check. `step_cost`: seconds of
/// one core for a step of an element. A case that asks for a fidelity is predicted by it. Meshes that the check knows
/// are not rebuilt. Adds none to a frame. Throws std::bad_alloc when a mesh does not fit.
void add_fidelities(const v1::Case& submitted, double step_cost, CaseCheck& check);

}  // namespace cellcrush::translate
