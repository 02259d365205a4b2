#include "step/step_record.h"

#include <algorithm>

#include "motion/periodic_sides.h"

namespace cellcrush {

void begin_record(const Scene& scene, const State& state, double time, double travel, StepRecord& record) {
  record.time = time;
  record.plates = plate_step_of(scene, state, time, travel);
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
  for (const Pusher* pusher : pushers()) {
    pusher->accumulate(scene, record.plates, state);
  }
  works_of_sides(state).accumulate(state.ledger);
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
