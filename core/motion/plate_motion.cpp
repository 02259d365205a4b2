#include "motion/plate_motion.h"

#include <algorithm>

namespace cellcrush {

double Plates::speed_at(double time) const {
  return ramp_time == 0.0 || time >= ramp_time ? speed : speed * std::max(time, 0.0) / ramp_time;
}

double plate_speed_at(const Scene& scene, const State& state, double time) {
  if (state.plate_drive.empty()) return scene.plates.speed_at(time);
  const PlateDrive& drive = state.plate_drive.front();
  return drive.speed + drive.rate * (time - drive.since);
}

}  // namespace cellcrush
