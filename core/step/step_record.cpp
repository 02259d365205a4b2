#include "step/step_record.h"

#include <algorithm>

#include "motion/rigid_wall_motion.h"

namespace cellcrush {

void begin_record(const Scene& scene, const State& state, double time, double travel, StepRecord& record) {
  const double dt = scene.schedule.time_step;
  record.time = time;
  record.plates = plate_step_of(scene, time, travel);
  record.plate = {record.plates.travel, scene.plates.speed_at(time + 0.5 * dt)};
  record.reach = reach_of_plates(scene, record.plates.travel);
  record.of_rigid_bodies = MotionWorks();
  record.moved.resize(moved_chunk_count(scene));
  record.near.resize(scene.bands.size());
  record.plastic_work.resize(static_cast<std::size_t>(scene.walls.chunk_count()));
  record.contacts = begin_contact_sums(state);
  record.has_crossed = false;
}

void accumulate(const Scene& scene, const StepRecord& record, State& state) {
  record.of_rigid_bodies.accumulate(state.ledger);
  for (const MovedChunk& chunk : record.moved) {
    chunk.works.accumulate(state.ledger);
  }
  accumulate_plates(scene, record.plates, state);
  accumulate_rigid_walls(scene, record.time, state);
  for (const double work : record.plastic_work) {
    state.ledger.plastic += work;
  }
  const ContactTotals before = state.contact_totals;
  put_contact_sums(record.contacts, state);
  state.contact_totals.deepest_penetration =
      std::max(before.deepest_penetration, state.contact_totals.deepest_penetration);
  state.contact_totals.deepest_birth = std::max(before.deepest_birth, state.contact_totals.deepest_birth);
}

}  // namespace cellcrush
