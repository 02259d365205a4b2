#include "contact/contact_tiles.h"

#include <algorithm>
#include <bit>

namespace cellcrush {
namespace {

void clear_range(State& state, int first, int end) {
  std::fill(state.contact_force.begin() + first, state.contact_force.begin() + end, ContactForce());
}

/// Most particles bear no contact force: only tiles that may are written.
void clear_marked_tiles(State& state, int first, int end) {
  constexpr auto kTile = static_cast<int>(kContactTile);
  constexpr auto kWord = static_cast<int>(kTilesInWord);
  const int end_tile = (end + kTile - 1) / kTile;
  for (int next = first / kTile; next < end_tile; next = (next / kWord + 1) * kWord) {
    std::uint64_t marked = flags_of_word(state.contact_tiles.data(), next / kWord) >> (next % kWord);
    for (; marked != 0 && next + std::countr_zero(marked) < end_tile; marked &= marked - 1) {
      const int tile = next + std::countr_zero(marked);
      clear_range(state, std::max(tile * kTile, first), std::min((tile + 1) * kTile, end));
    }
  }
}

}  // namespace

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

void clear_contact_forces(State& state, int first, int end) {
  if (state.contact_tiles.empty()) {
    clear_range(state, first, end);
  } else {
    clear_marked_tiles(state, first, end);
  }
  if (!state.contact_moment.empty()) {
    std::fill(state.contact_moment.begin() + first, state.contact_moment.begin() + end, 0.0);
  }
  if (!state.friction_force.empty()) {
    std::fill(state.friction_force.begin() + first, state.friction_force.begin() + end, Vector2::Zero());
  }
}

}  // namespace cellcrush
