#pragma once

#include <algorithm>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// Walls that overlap before loading (E8f): at sharp joints, where a ligament leaves a ring along it, as foils side by
// side. Were their balls to touch with the whole reach, contacts would push before anything has moved. Until a ball has
// parted from such a wall, its reach is at most the distance at which they stand, so that they push each other only
// when they come closer. A reach that is constant keeps the force the gradient of a stored energy. It is lifted while
// nothing touches, so that no energy comes from it.
//
// The limit is that of a ball and a whole wall, not of a ball and a segment: a ball that slides along the wall would
// otherwise come to segments that it did not overlap, and jump off them.

/// Steps from one look for parted walls to the next. Walls that part and meet again in between keep their limit.
inline constexpr int kStepsBetweenPartings = 8;

/// Reach over distance of those that overlap: round-off of walls that move as one must not make them touch.
inline constexpr double kKeptDistance = 1.0 - 0x1p-20;

/// Greatest distance at which a ball and a segment touch now, mm (E8a, E8f); infinite if nothing limits it.
inline double most_reach_now(const Scene& scene, const State& state, int ball, int segment) {
  double most = scene.most_reach_of(ball, segment);
  if (!scene.start_overlaps.empty()) {
    for (int p = scene.start_overlaps.offset[ball]; p < scene.start_overlaps.offset[ball + 1]; ++p) {
      const StartOverlap& pair = scene.start_overlaps.pairs[p];
      most = state.parted[p] == 0 && scene.has(pair, segment) ? std::min(most, pair.reach) : most;
    }
  }
  return most;
}

/// Distance at which they touch now, with the thickness before loading, mm.
inline double reach_now(const Scene& scene, const State& state, int ball, int segment) {
  return std::min(scene.full_reach_of(ball, segment), most_reach_now(scene, state, ball, segment));
}

/// Notes the walls that have parted: no segment of the wall is within its whole reach of the ball. Their candidates
/// have that reach from now on. REQUIRES: one band, as always with such walls.
void note_parted_walls(const Scene& scene, State& state);

}  // namespace cellcrush
