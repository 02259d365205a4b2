#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Says that a particle may have a contact force, unless that may be any. The last joints share a lot with the first particles
/// inside walls, which another thread may move meanwhile: it finds the lot marked or not, and what it moves has no such force.
inline void mark_contact_lot(State& state, int particle) {
  if (!state.contact_lots.empty()) {
    std::atomic_ref(state.contact_lots[static_cast<std::size_t>(particle) / State::kContactLot])
        .store(1, std::memory_order_relaxed);
  }
}

/// The same of the particles of a pair that has come to touch.
void mark_contact_lots(const Scene& scene, State& state, int ball, int segment);

/// Lets go of the lots of pairs that have parted, if that is due every so many steps and one of the newest `steps` is it.
void renew_contact_lots(const Scene& scene, State& state, std::int64_t steps);

/// Whether one of some particles may have a contact force, by State::contact_lots; null: any may.
/// REQUIRES: no more than kContactLot of them.
inline bool may_bear_contact(const std::uint8_t* lots, std::size_t first, std::size_t count) {
  const auto is_marked = [&](std::size_t particle) {
    auto& lot = const_cast<std::uint8_t&>(lots[particle / State::kContactLot]);
    return std::atomic_ref(lot).load(std::memory_order_relaxed) != 0;
  };
  return lots == nullptr || is_marked(first) || is_marked(first + count - 1);
}

}  // namespace cellcrush
