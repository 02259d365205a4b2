#include "touch/clear_forces.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "touch/contact_tiles.h"

namespace cellcrush {
namespace {

/// Most particles bear no contact force: only tiles that may are written.
void clear_marked_tiles(State& state, int first, int end) {
  constexpr auto kTile = static_cast<int>(kContactTile);
  constexpr int kParticlesOfWord = kTile * static_cast<int>(kTilesInWord);
  for (int word = first / kParticlesOfWord; word * kParticlesOfWord < end; ++word) {
    for (std::uint64_t marked = flags_of_word(state.contact_tiles.data(), word); marked != 0; marked &= marked - 1) {
      const int start = word * kParticlesOfWord + std::countr_zero(marked) * kTile;
      const int begin_in_range = std::clamp(start, first, end);
      const int end_in_range = std::clamp(start + kTile, first, end);
      std::fill(state.contact_force.begin() + begin_in_range, state.contact_force.begin() + end_in_range,
                ContactForce());
    }
  }
}

void clear_range(State& state, int first, int end) {
  if (state.contact_tiles.empty()) {
    std::fill(state.contact_force.begin() + first, state.contact_force.begin() + end, ContactForce());
  } else {
    clear_marked_tiles(state, first, end);
  }
  if (!state.friction_force.empty()) {
    std::fill(state.friction_force.begin() + first, state.friction_force.begin() + end, Vector2::Zero());
  }
}

}  // namespace

void clear_contact_forces(State& state, const LatticeBand& band) {
  clear_range(state, band.first_joint, band.end_joint);
  clear_range(state, band.first_inner, band.end_inner);
}

}  // namespace cellcrush
