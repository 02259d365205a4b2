#include "motion/supports.h"

namespace cellcrush {

double held_velocity(const Scene& scene, const State& state, const Hold& hold) {
  if (hold.motion < 0) {
    return 0.0;
  }
  const TimeFunction& motion = scene.motions[hold.motion];
  const double step = scene.schedule.time_step;
  return (motion.value_at(state.time + step) - motion.value_at(state.time)) / step;
}

}  // namespace cellcrush
