#pragma once

#include <string>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "core/reference/reference_crush.h"

namespace cellcrush {

/// A scene as the oracle takes it: mesh, rule, material, contact and plate data, time step. Masses, balls and reaches
/// are the oracle's own.
/// REQUIRES: real masses, no supports and no loads but those of the plates.
reference::Lattice lattice_of(const Scene& scene);

/// The rule of a scene's elements.
reference::ElementRule element_rule_of(const Scene& scene);

/// The elements of every wall that can deform, from its start to its end.
std::vector<std::vector<int>> walls_of(const Scene& scene);

/// Material, section and undeformed length of an element.
reference::ElementData element_data_of(const Scene& scene, std::size_t element);

/// What an element has of a state. Of a rule that keeps no history of a kind, that is left as of an undeformed element.
reference::ElementHistory element_history_of(const Scene& scene, const State& state, std::size_t element);

/// A state as the oracle has it.
reference::Instant instant_of(const Scene& scene, const State& state);

}  // namespace cellcrush
