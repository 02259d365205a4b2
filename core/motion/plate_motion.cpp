#include "motion/plate_motion.h"

namespace cellcrush {

PlateStep plate_step_of(const Scene& scene, double time, double travel) {
  const double step = scene.schedule.time_step;
  const double speed_before = scene.plates.speed_at(time - 0.5 * step);
  const double speed_after = scene.plates.speed_at(time + 0.5 * step);
  return {0.5 * step * (speed_before + speed_after), travel + step * speed_after};
}

void accumulate_plate_work(const State& state, double displacement, Ledger& ledger) {
  ledger.contact += state.impact_force.elastic * displacement;
  ledger.contact_damping += state.impact_force.viscous * displacement;
  ledger.external += state.impact_force.total() * displacement;
}

void accumulate_plates(const Scene& scene, const PlateStep& plates, State& state) {
  const double step = scene.schedule.time_step;
  accumulate_plate_work(state, plates.displacement, state.ledger);
  state.impact_impulse += step * state.impact_force.total();
  state.support_impulse += step * state.support_force.total();
  state.impact_travel = plates.travel;
}

}  // namespace cellcrush
