#include <algorithm>

#include "cellcrush/scene.h"

namespace cellcrush {

double TimeFunction::value_at(double time) const {
  const auto after = std::upper_bound(points.begin(), points.end(), time,
                                      [](double t, const std::pair<double, double>& point) { return t < point.first; });
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
  if (ramp_time == 0.0) {
    return speed;
  }
  return time < ramp_time ? speed * std::max(time, 0.0) / ramp_time : speed;
}

}  // namespace cellcrush
