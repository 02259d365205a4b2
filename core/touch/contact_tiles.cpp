#include "touch/contact_tiles.h"

namespace cellcrush {

void mark_contact_tiles(const Scene& scene, State& state, int ball, int segment) {
  mark_contact_tile(state, ball);
  mark_contact_tile(state, scene.elements[segment].start);
  mark_contact_tile(state, scene.elements[segment].end);
}

void rebuild_contact_tiles(const Scene& scene, State& state, std::int64_t steps) {
  if (!state.contact_tiles.empty() && state.step % kStepsBetweenTiles >= steps) {
    return;
  }
  state.contact_tiles.assign(scene.particle_count() / (kContactTile * kTilesInWord) + 1, 0);
  for (const ContactLists& lists : state.contacts) {
    for (std::size_t i = 0; i < lists.touching.count(); ++i) {
      mark_contact_tiles(scene, state, lists.touching.ball[i], lists.touching.segment[i]);
    }
  }
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const ContactForce& force = state.contact_force[i];
    if (!force.elastic.isZero(0.0) || !force.viscous.isZero(0.0)) {
      mark_contact_tile(state, static_cast<int>(i));
    }
  }
}

}  // namespace cellcrush
