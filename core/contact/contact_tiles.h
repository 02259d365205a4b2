#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Tiles whose flags are the bits of a word of State::contact_tiles.
inline constexpr std::size_t kTilesInWord = 64;

/// The flags of a word. Another thread may mark tiles at the same time, as the last joints share a tile with the first
/// particles inside walls. This thread may find its marks or not: the particles that it moves have no such force.
inline std::uint64_t flags_of_word(const std::uint64_t* tiles, std::size_t word) {
  return std::atomic_ref(const_cast<std::uint64_t&>(tiles[word])).load(std::memory_order_relaxed);
}

/// Marks the tile of a particle that may have a contact force. Does nothing if the flags are empty, that is, if any
/// particle may have one.
inline void mark_contact_tile(State& state, int particle) {
  if (!state.contact_tiles.empty()) {
    const std::size_t tile = static_cast<std::size_t>(particle) / kContactTile;
    const std::uint64_t flag = std::uint64_t{1} << (tile % kTilesInWord);
    if ((flags_of_word(state.contact_tiles.data(), tile / kTilesInWord) & flag) == 0) {
      std::atomic_ref(state.contact_tiles[tile / kTilesInWord]).fetch_or(flag, std::memory_order_relaxed);
    }
  }
}

/// The same for the particles of a pair that has begun to touch.
void mark_contact_tiles(const Scene& scene, State& state, int ball, int segment);

/// Rebuilds the flags every 64 steps, so that tiles of released pairs are cleared. `steps`: how many steps were just
/// taken.
void rebuild_contact_tiles(const Scene& scene, State& state, std::int64_t steps);

/// Sets the contacts' forces on the particles `first` ... `end` to 0, friction included: those of the step are added to
/// it.
void clear_contact_forces(State& state, int first, int end);

/// Whether one of `count` particles from `first` on may have a contact force, by State::contact_tiles; null: any may.
/// REQUIRES: count <= kContactTile.
inline bool may_bear_contact(const std::uint64_t* tiles, std::size_t first, std::size_t count) {
  const auto is_marked = [&](std::size_t particle) {
    const std::size_t tile = particle / kContactTile;
    return (flags_of_word(tiles, tile / kTilesInWord) >> (tile % kTilesInWord) & 1) != 0;
  };
  return tiles == nullptr || is_marked(first) || is_marked(first + count - 1);
}

}  // namespace cellcrush
