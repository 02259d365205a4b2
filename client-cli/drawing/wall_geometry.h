#pragma once

#include <vector>

#include "drawing/drawing.h"

namespace cellcrush::drawing {

/// A straight wall or an arc of a circle, for questions about places on it. A place is on it if it is within a
/// tolerance of it, and farther than that from both ends.
class WallCurve {
 public:
  WallCurve(const DrawnPlace& start, const DrawnPlace& end, double rise);

  [[nodiscard]] double length() const { return length_; }
  /// The place at a share of the length.
  [[nodiscard]] DrawnPlace place_at(double share) const;
  /// The share of the length at which a place is on the wall; less than 0 where it is not.
  [[nodiscard]] double share_of(const DrawnPlace& place, double tolerance) const;
  /// The rise of a part of the wall between two shares.
  [[nodiscard]] double rise_between(double from, double to) const;
  /// Where two walls cross between their ends: at most two places.
  [[nodiscard]] std::vector<DrawnPlace> crossings_with(const WallCurve& other, double tolerance) const;

 private:
  [[nodiscard]] bool is_arc() const { return turn_ != 0.0; }
  /// Where the lines or circles meet on which the walls lie.
  [[nodiscard]] std::vector<DrawnPlace> meetings_with(const WallCurve& other) const;
  [[nodiscard]] std::vector<DrawnPlace> meetings_with_circle(const DrawnPlace& centre, double radius) const;

  DrawnPlace start_;
  DrawnPlace end_;
  DrawnPlace centre_;    ///< of an arc
  double radius_ = 0.0;  ///< of an arc
  double from_ = 0.0;    ///< angle of the start, of an arc
  double turn_ = 0.0;    ///< angle from start to end; 0: straight
  double length_ = 0.0;
};

}  // namespace cellcrush::drawing
