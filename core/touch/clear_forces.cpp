#include "touch/clear_forces.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace cellcrush {
namespace {

constexpr int kTile = static_cast<int>(kContactTile);

/// Whether one of the next tiles may bear contact forces. Another thread may mark the tile that joints share with the
/// particles inside walls.
bool any_is_marked(const State& state, int first_tile, int count) {
  unsigned marked = 0;
  for (int tile = first_tile; tile < first_tile + count; ++tile) {
    auto& flag = const_cast<std::uint8_t&>(state.contact_tiles[static_cast<std::size_t>(tile)]);
    marked |= std::atomic_ref(flag).load(std::memory_order_relaxed);
  }
  return marked != 0;
}

/// Most particles bear no contact force: only tiles that may are written.
void clear_marked_tiles(State& state, int first, int end) {
  constexpr int kTilesTogether = 8;
  const int end_tile = (end + kTile - 1) / kTile;
  for (int tile = first / kTile; tile < end_tile; tile += kTilesTogether) {
    const int end_together = std::min(tile + kTilesTogether, end_tile);
    if (!any_is_marked(state, tile, end_together - tile)) {
      continue;
    }
    for (int marked = tile; marked < end_together; ++marked) {
      if (any_is_marked(state, marked, 1)) {
        std::fill(state.contact_force.begin() + std::max(marked * kTile, first),
                  state.contact_force.begin() + std::min((marked + 1) * kTile, end), ContactForce());
      }
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
