#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Whether the centre lines of two elements without a common node cross.
inline bool cross_each_other(const State& state, const Element& one, const Element& other) {
  const auto side_of = [&](const Element& line, int particle) {
    const Vector2& start = state.position[line.start];
    return cross(state.position[line.end] - start, state.position[particle] - start);
  };
  return !share_a_node(one, other) && side_of(one, other.start) * side_of(one, other.end) < 0.0 &&
         side_of(other, one.start) * side_of(other, one.end) < 0.0;
}

}  // namespace cellcrush
