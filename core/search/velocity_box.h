#pragma once

#include <span>

#include "cellcrush/state.h"

namespace cellcrush {

/// Box round velocities, mm/s.
struct VelocityBox {
  Vector2 low;
  Vector2 high;
};

/// Box round the velocities of some particles. REQUIRES: at least one member.
VelocityBox box_of_velocities(const State& state, std::span<const int> members);

}  // namespace cellcrush
