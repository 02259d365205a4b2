#include <algorithm>

#include "cellcrush/scene.h"

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

double Plates::speed_at(double time) const {
  return ramp_time == 0.0 || time >= ramp_time ? speed : speed * std::max(time, 0.0) / ramp_time;
}

}  // namespace cellcrush
