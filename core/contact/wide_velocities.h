#pragma once

#include <span>

#include "cellcrush/state.h"

namespace cellcrush {

/// Box round velocities, mm/s.
struct VelocityBox {
  Vector2 low;
  Vector2 high;
};

/// Box round the velocities of some particles, with the processor's vector instructions: the same bits as one by one, as
/// nothing is rounded. REQUIRES: at least one member.
VelocityBox box_of_velocities_wide(const State& state, std::span<const int> members);

}  // namespace cellcrush
