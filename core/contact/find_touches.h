#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// A ball that is pushed by a segment.
struct Touch {
  int memory = 0;  ///< into State::touching
  int ball = 0;
  int segment = 0;
  double reach = 0.0;   ///< mm, distance at which they touch
  double share = 0.0;   ///< of the foot along the segment: 0 at its start, 1 at its end
  double depth = 0.0;   ///< D, mm
  Vector2 normal;       ///< from the segment to the ball
  bool is_new = false;  ///< did not touch in the step before

  // Two balls that touch are found by each of them, and a ball over a node of a straight chain by the node's ball, too: what
  // such a pair would store is taken back, half of it with either touch.
  int node = -1;            ///< particle of the polyline nearest to the ball, whose ball it touches; -1: none
  double node_depth = 0.0;  ///< of the two balls, at most D, mm
  Vector2 node_normal = Vector2::Zero();

  /// Of the pair's viscous force and friction, this touch has all or none.
  bool has_pair = true;
  double net_depth =
      0.0;  ///< mm: k times it is the normal force by which its viscous force is bounded and friction goes
};

/// Overwrites State::touching by the pairs that overlap now: those that did before keep what they remember. Of them the
/// touches that push, by ball, segments ascending: of touching segments that share a node only the deepest.
std::vector<Touch> find_touches(const Scene& scene, State& state);

inline bool share_a_node(const Element& a, const Element& b) {
  return a.start == b.start || a.start == b.end || a.end == b.start || a.end == b.end;
}

}  // namespace cellcrush
