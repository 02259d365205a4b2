#include <algorithm>
#include <cmath>
#include <limits>

#include "cellcrush/loads.h"

namespace cellcrush {

double TimeFunction::value_at(double time) const {
  const auto after = std::ranges::upper_bound(points, time, {}, &std::pair<double, double>::first);
  if (after == points.begin()) {
    return points.front().second;
  }
  if (after == points.end()) {
    return points.back().second;
  }
  const auto& [t0, v0] = *(after - 1);
  const auto& [t1, v1] = *after;
  return v0 + (v1 - v0) * (time - t0) / (t1 - t0);
}

TimeFunction TimeFunction::integral() const {
  constexpr double kLong = 1e6;  // s
  TimeFunction sum = {{{0.0, 0.0}}};
  double before = value_at(0.0);
  const auto go_to = [&](double time, double value) {
    const auto [last, total] = sum.points.back();
    sum.points.emplace_back(time, total + 0.5 * (before + value) * (time - last));
    before = value;
  };
  for (const auto& [time, value] : points) {
    if (time > 0.0) go_to(time, value);
  }
  go_to(sum.points.back().first + kLong, before);
  return sum;
}

double RigidWall::speed_by_force(double way) const {
  double impulse = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i < force.points.size(); ++i) {
    const auto& [time, value] = force.points[i];
    most = std::max(most, value);
    const auto& [before, start] = force.points[i == 0 ? 0 : i - 1];
    impulse += 0.5 * (std::max(0.0, start) + std::max(0.0, value)) * (time - before);
  }
  if (!force.points.empty() && force.points.back().second > 0.0) impulse = std::numeric_limits<double>::infinity();
  return mass > 0.0 ? std::min(impulse / mass, std::sqrt(2.0 * most * way / mass)) : 0.0;
}

}  // namespace cellcrush
