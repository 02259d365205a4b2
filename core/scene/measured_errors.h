#pragma once

#include <string>
#include <vector>

#include "cellcrush/fidelity.h"

namespace cellcrush {

/// Fields in which a spec differs from every measured specimen so that the errors do not hold for it: those of the
/// specimen from which it differs least. Empty if it is one of them, or the same lattice with more cells.
std::vector<std::string> fields_beside_measured(const SceneSpec& spec);

/// Errors of a spec that differs in no such field, with a mesh. Between two measured speeds the larger error counts.
std::vector<MeasuredError> measured_errors_of(const SceneSpec& spec, int elements_per_wall);

}  // namespace cellcrush
