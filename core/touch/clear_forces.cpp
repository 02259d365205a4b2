#include "touch/clear_forces.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "touch/contact_tiles.h"

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
  for (int tile = first / kTile; tile < end_tile; tile = (tile / kWord + 1) * kWord) {
    std::uint64_t marked = flags_of_word(state.contact_tiles.data(), tile / kWord) >> (tile % kWord);
    for (int i = tile; marked != 0 && i < end_tile; ++i, marked >>= 1) {
      const int skipped = std::countr_zero(marked);
      i += skipped;
      marked >>= skipped;
      if (i < end_tile) {
        clear_range(state, std::max(i * kTile, first), std::min((i + 1) * kTile, end));
      }
    }
  }
}

}  // namespace

void clear_contact_forces(State& state, int first, int end) {
  if (state.contact_tiles.empty()) {
    clear_range(state, first, end);
  } else {
    clear_marked_tiles(state, first, end);
  }
  if (!state.friction_force.empty()) {
    std::fill(state.friction_force.begin() + first, state.friction_force.begin() + end, Vector2::Zero());
  }
}

}  // namespace cellcrush
