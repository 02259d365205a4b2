#pragma once

#include <optional>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

// Range of solids: densities from polymers to osmium, stiffness from rubbers to diamond, and their yield strains.
inline constexpr double kLightest = 300.0;      // kg/m^3
inline constexpr double kHeaviest = 23000.0;    // kg/m^3
inline constexpr double kSoftest = 500.0;       // MPa
inline constexpr double kStiffest = 1.3e6;      // MPa
inline constexpr double kLeastYield = 2e-5;     // strain
inline constexpr double kGreatestYield = 0.05;  // strain
/// Speed of a plate over that of an elastic wave in the walls up to which neither strain rates nor heat matter.
inline constexpr double kFastest = 0.1;

/// A case whose numbers make sense together in other units than those of its fields, such as tonne/mm^3 or SI metres:
/// material, wave speed and wall thickness are those of a cellular solid in these units and not as given. The problem
/// names the units, and gives the fields with converted values. Nothing if the numbers make sense as they are, or in no
/// set of units. Of a frame without a material of its own, that of its first beam counts.
std::optional<Problem> find_other_units(const SceneSpec& spec);

/// Puts that problem before those of a spec, if there are any, in place of what follows from the units: problems of the
/// material, the step and the number of steps.
void ask_about_units_first(const SceneSpec& spec, Problems& problems);

}  // namespace cellcrush
