#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// Says that a particle may have a contact force, unless that may be any.
inline void mark_contact_lot(State& state, int particle) {
  if (!state.contact_lots.empty()) {
    state.contact_lots[static_cast<std::size_t>(particle) / State::kContactLot] = 1;
  }
}

/// Marks the lots of the pairs that have come to touch in this step, or every so many steps, when those of pairs that have
/// parted are let go, the lots of all that touch. REQUIRES: no particle has a contact force yet.
void note_contact_lots(const Scene& scene, State& state, std::span<const Newcomer> newcomers);

/// Whether one of some particles may have a contact force, by State::contact_lots; null: any may.
/// REQUIRES: no more than kContactLot of them.
inline bool may_bear_contact(const std::uint8_t* lots, std::size_t first, std::size_t count) {
  return lots == nullptr || (lots[first / State::kContactLot] | lots[(first + count - 1) / State::kContactLot]) != 0;
}

}  // namespace cellcrush
