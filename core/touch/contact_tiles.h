#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Marks the tile of a particle that may have a contact force; does nothing where any may. The last joints share a tile
/// with the first particles inside walls, which another thread may move at the same time. Whether it finds the tile
/// marked or not, the particles it moves have no such force.
inline void mark_contact_tile(State& state, int particle) {
  if (!state.contact_tiles.empty()) {
    std::atomic_ref(state.contact_tiles[static_cast<std::size_t>(particle) / kContactTile])
        .store(1, std::memory_order_relaxed);
  }
}

/// The same for the particles of a pair that has come to touch.
void mark_contact_tiles(const Scene& scene, State& state, int ball, int segment);

/// Rebuilds the flags every 64 steps, so that tiles of released pairs are cleared. `steps`: how many were just taken.
void rebuild_contact_tiles(const Scene& scene, State& state, std::int64_t steps);

/// Whether one of `count` particles may have a contact force, by State::contact_tiles; null: any may.
/// REQUIRES: no more than kContactTile of them.
inline bool may_bear_contact(const std::uint8_t* tiles, std::size_t first, std::size_t count) {
  const auto is_marked = [&](std::size_t particle) {
    auto& tile = const_cast<std::uint8_t&>(tiles[particle / kContactTile]);
    return std::atomic_ref(tile).load(std::memory_order_relaxed) != 0;
  };
  return tiles == nullptr || is_marked(first) || is_marked(first + count - 1);
}

}  // namespace cellcrush
