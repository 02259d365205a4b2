#pragma once

#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// A trade-off between speed and accuracy: the settings that it fills in where a spec omits them.
struct FidelityPoint {
  NumericsSpec::Fidelity fidelity = NumericsSpec::Fidelity::unspecified;
  std::string name;  ///< as written in a case
  int elements_per_wall = 0;
};

/// DRAFT, STANDARD, REFERENCE for the lattice and the elements of a spec.
std::vector<FidelityPoint> fidelity_points(const SceneSpec& spec);

/// The spec with the settings of its fidelity, or the defaults if it names none, filled in where it omits them. Given
/// settings are kept.
SceneSpec fill_in_fidelity(const SceneSpec& spec);

/// Which mesh a spec gets and why, as a sentence; empty for a frame.
std::string describe_fidelity(const SceneSpec& spec);

}  // namespace cellcrush
