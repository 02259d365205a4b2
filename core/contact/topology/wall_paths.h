#pragma once

#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Reach of balls and segments that are joined by a short path along the undeformed walls (E8a). They are neighbours at
/// a joint, or elements of one wall that is thicker than they are long. The reach is a property of the pair alone.
class WallPaths {
 public:
  /// Reach as a fraction of the path between ball and segment, the 0.4 of E8a. Below 1/2, the distance over the path
  /// for two points equally far from the corner of an equilateral triangle. Walls that meet at more than 48 degrees
  /// then do not touch before loading, whatever their thickness.
  static constexpr double kTouchingShare = 0.4;

  explicit WallPaths(const Scene& scene);

  /// Distance at which they touch, mm: radius plus half thickness (Eq. 41, E8). If it is less, kTouchingShare of the
  /// path from the ball to the nearer end of the segment (E8a). Cheap if balls are visited in the order of particles.
  double reach_of(int ball, int segment);

  /// kTouchingShare of that path, mm; anything above `most` if it is longer.
  double limit_of(int ball, int segment, double most);

  /// Segments whose limit_of may be below `largest`, mm; ascending. Those of the ball itself are left out, those of
  /// other joints of its pin (E16) are not.
  std::vector<int> segments_near(int ball, double largest);

 private:
  /// Finds the path lengths from the ball to all particles nearer than the limit.
  void walk_from(int ball, double limit);

  const Scene& scene_;
  std::vector<int> pin_of_;  // of each particle, -1: none; empty in a scene without pins
  int ball_ = -1;
  double limit_ = 0.0;
  std::vector<double> way_;   // path length to each particle, infinite if not reached; empty until the first call
  std::vector<int> reached_;  // particles with a finite path length
};

/// Whether an element ends at a particle. None does at a node to which all beams are pinned: it has no ball.
inline bool has_elements(const Scene& scene, int particle) {
  return scene.incidence_offset[particle] < scene.incidence_offset[particle + 1];
}

/// The limited reaches of all pairs of a scene (E8a).
LimitedReaches find_limited_reaches(const Scene& scene);

}  // namespace cellcrush
