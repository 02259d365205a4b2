#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Sums the forces of walls on joints `first` to `end` (E7), for each joint in a fixed order. The sums therefore have
/// the same bits for any thread. Does nothing if first >= end.
void sum_joint_forces(const Scene& scene, State& state, std::size_t first, std::size_t end);

/// The same for all joints.
void sum_joint_forces(const Scene& scene, State& state, Workers& workers);

}  // namespace cellcrush
