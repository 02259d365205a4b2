#include "drawing/wall_geometry.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace cellcrush::drawing {

WallCurve::WallCurve(const DrawnPlace& start, const DrawnPlace& end, double rise) : start_(start), end_(end) {
  const double chord = distance(start, end);
  length_ = chord;
  if (rise == 0.0) return;
  // A rise to the left turns clockwise. Its tangent is that of a quarter of the turn.
  turn_ = -4.0 * std::atan(2.0 * rise / chord);
  radius_ = chord / (2.0 * std::abs(std::sin(0.5 * turn_)));
  length_ = radius_ * std::abs(turn_);
  const DrawnPlace left = {-(end.y - start.y) / chord, (end.x - start.x) / chord};
  const double height = 0.5 * chord / std::tan(0.5 * turn_);  // of the centre, to the left of the chord
  centre_ = {0.5 * (start.x + end.x) + height * left.x, 0.5 * (start.y + end.y) + height * left.y};
  from_ = std::atan2(start.y - centre_.y, start.x - centre_.x);
}

DrawnPlace WallCurve::place_at(double share) const {
  if (!is_arc()) return {start_.x + share * (end_.x - start_.x), start_.y + share * (end_.y - start_.y)};
  const double angle = from_ + share * turn_;
  return {centre_.x + radius_ * std::cos(angle), centre_.y + radius_ * std::sin(angle)};
}

double WallCurve::share_of(const DrawnPlace& place, double tolerance) const {
  double across = 0.0;
  double along = 0.0;
  if (is_arc()) {
    across = distance(place, centre_) - radius_;
    double angle = std::atan2(place.y - centre_.y, place.x - centre_.x) - from_;
    if (turn_ < 0.0) angle = -angle;
    constexpr double kTurn = 2.0 * std::numbers::pi;
    angle -= kTurn * std::floor(angle / kTurn);
    along = radius_ * angle;
  } else {
    const DrawnPlace to = {(end_.x - start_.x) / length_, (end_.y - start_.y) / length_};
    along = (place.x - start_.x) * to.x + (place.y - start_.y) * to.y;
    across = (place.x - start_.x) * to.y - (place.y - start_.y) * to.x;
  }
  const bool is_on = std::abs(across) <= tolerance && along > tolerance && along < length_ - tolerance;
  return is_on ? along / length_ : -1.0;
}

double WallCurve::rise_between(double from, double to) const {
  if (!is_arc()) return 0.0;
  const double turn = turn_ * (to - from);
  return -(turn < 0.0 ? -1.0 : 1.0) * radius_ * (1.0 - std::cos(0.5 * turn));
}

std::vector<DrawnPlace> WallCurve::meetings_with_circle(const DrawnPlace& centre, double radius) const {
  // On the line of the chord, or on the line through the meetings of two circles: foot and half of the chord in it.
  DrawnPlace foot;
  DrawnPlace along;
  double square = 0.0;
  if (is_arc()) {
    const double apart = distance(centre_, centre);
    if (apart == 0.0) return {};
    const DrawnPlace to = {(centre.x - centre_.x) / apart, (centre.y - centre_.y) / apart};
    const double reach = (apart * apart + radius_ * radius_ - radius * radius) / (2.0 * apart);
    foot = {centre_.x + reach * to.x, centre_.y + reach * to.y};
    along = {-to.y, to.x};
    square = radius_ * radius_ - reach * reach;
  } else {
    along = {(end_.x - start_.x) / length_, (end_.y - start_.y) / length_};
    const double reach = (centre.x - start_.x) * along.x + (centre.y - start_.y) * along.y;
    foot = {start_.x + reach * along.x, start_.y + reach * along.y};
    square = radius * radius - std::pow(distance(foot, centre), 2);
  }
  if (square < 0.0) return {};
  const double half = std::sqrt(square);
  std::vector<DrawnPlace> places = {{foot.x - half * along.x, foot.y - half * along.y}};
  if (half > 0.0) places.push_back({foot.x + half * along.x, foot.y + half * along.y});
  return places;
}

std::vector<DrawnPlace> WallCurve::meetings_with(const WallCurve& other) const {
  if (other.is_arc()) return meetings_with_circle(other.centre_, other.radius_);
  if (is_arc()) return other.meetings_with_circle(centre_, radius_);
  const DrawnPlace u = {end_.x - start_.x, end_.y - start_.y};
  const DrawnPlace v = {other.end_.x - other.start_.x, other.end_.y - other.start_.y};
  const double turn = u.x * v.y - u.y * v.x;
  if (turn == 0.0) return {};
  const double share = ((other.start_.x - start_.x) * v.y - (other.start_.y - start_.y) * v.x) / turn;
  return {{start_.x + share * u.x, start_.y + share * u.y}};
}

std::vector<DrawnPlace> WallCurve::crossings_with(const WallCurve& other, double tolerance) const {
  std::vector<DrawnPlace> places = meetings_with(other);
  std::erase_if(places, [&](const DrawnPlace& place) {
    return share_of(place, tolerance) < 0.0 || other.share_of(place, tolerance) < 0.0;
  });
  return places;
}

}  // namespace cellcrush::drawing
