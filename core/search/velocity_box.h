#pragma once

#include <span>

#include "cellcrush/state.h"

namespace cellcrush {

/// Bounding box of velocities, mm/s; v_low and v_high of E8c.
struct VelocityBox {
  Vector2 low;
  Vector2 high;
};

/// Bounding box of the velocities of some particles. REQUIRES: at least one member.
VelocityBox box_of_velocities(const State& state, std::span<const int> members);

}  // namespace cellcrush
