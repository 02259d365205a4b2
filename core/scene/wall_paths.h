#pragma once

#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {

/// How near balls and segments may come which a short way along the undeformed walls joins: neighbours at a joint, or
/// elements of one wall that is thicker than they are long. Where they touch is a property of the pair alone.
class WallPaths {
 public:
  /// Share of the way between them at which ball and segment touch. Below 1/2, the distance of two points equally far
  /// from the corner of a triangle: walls that meet at more than 48 degrees do not touch before loading, however thick.
  static constexpr double kTouchingShare = 0.4;

  explicit WallPaths(const Scene& scene) : scene_(scene) {}

  /// Distance at which they touch, mm: radius and half of the thickness (Eq. 41), or kTouchingShare of the way from the
  /// ball to the segment's nearer end if that is less. Cheap for balls in the order of particles.
  double reach_of(int ball, int segment);

  /// Segments but the ball's own that reach_of may limit, ascending. `largest`: the greatest radius and half thickness
  /// there is, mm.
  std::vector<int> segments_near(int ball, double largest);

 private:
  /// Ways from the ball to all particles nearer than the limit.
  void walk_from(int ball, double limit);

  const Scene& scene_;
  int ball_ = -1;
  double limit_ = 0.0;
  std::vector<double> way_;   // of all particles, infinite where not reached; empty until the first walk
  std::vector<int> reached_;  // particles with a finite way
};

/// The limited reaches of all pairs of a scene.
LimitedReaches find_limited_reaches(const Scene& scene);

}  // namespace cellcrush
