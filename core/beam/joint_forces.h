#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Sums the walls' forces on joints `first` to `end`, each joint's in a fixed order, so that the sums have the same
/// bits whoever computes them. Does nothing if first >= end.
void sum_joint_forces(const Scene& scene, State& state, std::size_t first, std::size_t end);

/// The same of all joints.
void sum_joint_forces(const Scene& scene, State& state, Workers& workers);

}  // namespace cellcrush
