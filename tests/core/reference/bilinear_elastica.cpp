#include "core/reference/bilinear_elastica.h"

#include <cmath>
#include <functional>

namespace cellcrush::reference {
namespace {

/// Root of a function that rises or falls through 0 once between two arguments.
double bisect(double low, double high, const std::function<double(double)>& function) {
  const bool rises = function(high) > 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((function(middle) > 0.0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// Of half of the wall, at the distance s from its middle.
struct Station {
  double angle;   // phi
  double moment;  // M
  double rise;    // integral of sin phi
};

/// The end of half a wall whose middle stands at `middle_angle` under a load.
Station end_of_half(const BilinearSection& section, double half_length, double load, double middle_angle) {
  constexpr int kSteps = 400;
  const double step = half_length / kSteps;
  const auto slope = [&](const Station& at) {
    return Station{section.curvature(at.moment), load * std::cos(at.angle), std::sin(at.angle)};
  };
  const auto moved = [](const Station& from, const Station& by, double times) {
    return Station{from.angle + times * by.angle, from.moment + times * by.moment, from.rise + times * by.rise};
  };
  Station at = {middle_angle, 0.0, 0.0};
  for (int i = 0; i < kSteps; ++i) {
    const Station a = slope(at);
    const Station b = slope(moved(at, a, 0.5 * step));
    const Station c = slope(moved(at, b, 0.5 * step));
    const Station d = slope(moved(at, c, step));
    at = moved(moved(moved(moved(at, a, step / 6.0), b, step / 3.0), c, step / 3.0), d, step / 6.0);
  }
  return at;
}

}  // namespace

double BilinearSection::curvature(double moment) const {
  const double inertia = thickness * thickness * thickness / 12.0;
  const double yield_moment = yield_stress * thickness * thickness / 6.0;
  const double yield_curvature = yield_moment / (modulus * inertia);
  if (moment <= yield_moment) {
    return moment / (modulus * inertia);
  }
  const double share = tangent / modulus;
  // Newton's iteration on the cubic in k_e / k is safe from above: the moment is concave in the curvature.
  double ratio = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double excess = (1.0 - share) * (1.5 - 0.5 / (ratio * ratio)) + share * ratio - moment / yield_moment;
    const double rate = (1.0 - share) / (ratio * ratio * ratio) + share;
    const double change = excess / rate;
    ratio -= change;
    if (std::abs(change) < 1e-13 * ratio) {
      break;
    }
  }
  return ratio * yield_curvature;
}

double load_of_pushed_wall(const BilinearSection& section, double length, double angle, double way) {
  const double half = 0.5 * length;
  const auto way_under = [&](double load) {
    const double middle_angle =
        bisect(angle - 1.2, angle, [&](double at) { return end_of_half(section, half, load, at).angle - angle; });
    return 2.0 * (half * std::sin(angle) - end_of_half(section, half, load, middle_angle).rise);
  };
  const double plastic_load = 0.5 * section.yield_stress * section.thickness * section.thickness / length;
  return bisect(0.0, 4.0 * plastic_load, [&](double load) { return way_under(load) - way; });
}

}  // namespace cellcrush::reference
