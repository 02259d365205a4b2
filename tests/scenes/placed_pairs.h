#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush::scenes {

/// A ball and a segment. Where the ball stands is chosen along and across the segment, so that all of their geometry is
/// known in closed form.
struct PlacedPair {
  Vector2 start;
  Vector2 axis;   ///< unit vector
  double length;  ///< mm
  double ahead;   ///< mm from the start along the axis; below 0 or above the length: beyond an end
  double across;  ///< mm from the segment's line, to its left
  double reach;   ///< mm

  [[nodiscard]] bool is_inside() const { return ahead > 0.0 && ahead < length; }
  [[nodiscard]] double distance() const;  ///< mm, of ball and segment
  [[nodiscard]] double to_start() const;  ///< mm, of ball and the segment's start
  [[nodiscard]] double to_end() const;    ///< mm
  [[nodiscard]] Vector2 ball() const;
  [[nodiscard]] Vector2 end() const { return start + length * axis; }
};

/// Pairs of all kinds, drawn from a fixed seed: balls beside the segment, beyond its ends, near and far.
std::vector<PlacedPair> draw_pairs(std::size_t count);

/// A scene of the pairs, each with three particles of its own: pair i has the segment i from particle 3 i to 3 i + 1,
/// and the ball 3 i + 2. Masses and velocities are drawn from a fixed seed.
struct PairScene {
  Scene scene;
  State state;

  explicit PairScene(const std::vector<PlacedPair>& pairs);
};

}  // namespace cellcrush::scenes
