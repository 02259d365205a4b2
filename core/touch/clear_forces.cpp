#include "touch/clear_forces.h"

#include <algorithm>
#include <utility>

#include "touch/contact_tiles.h"

namespace cellcrush {
namespace {

/// Most particles bear no contact force: only tiles that may are written.
void clear_range(State& state, int first, int end) {
  const std::uint8_t* const lots = state.contact_tiles.empty() ? nullptr : state.contact_tiles.data();
  constexpr int kTile = static_cast<int>(State::kContactTile);
  for (int tile = first; tile < end;) {
    const int next = std::min((tile / kTile + 1) * kTile, end);
    if (may_bear_contact(lots, static_cast<std::size_t>(tile), 1)) {
      std::fill(state.contact_force.begin() + tile, state.contact_force.begin() + next, ContactForce());
    }
    tile = next;
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
