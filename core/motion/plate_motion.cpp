#include "motion/plate_motion.h"

namespace cellcrush {

PlateStep plate_step_of(const Scene& scene, double time, double travel) {
  const double step = scene.schedule.time_step;
  const double speed_before = scene.plates.speed_at(time - 0.5 * step);
  const double speed_after = scene.plates.speed_at(time + 0.5 * step);
  return {0.5 * step * (speed_before + speed_after), travel + step * speed_after};
}

MotionWorks plate_works(const PlateForce& force, double displacement) {
  return {.contact = force.elastic * displacement,
          .contact_damping = force.viscous * displacement,
          .external = force.total() * displacement};
}

void accumulate_plates(const Scene& scene, const PlateStep& plates, State& state) {
  const double step = scene.schedule.time_step;
  plate_works(state.impact_force, plates.displacement).accumulate(state.ledger);
  state.impact_impulse += step * state.impact_force.total();
  state.support_impulse += step * state.support_force.total();
  state.impact_travel = plates.travel;
}

}  // namespace cellcrush
