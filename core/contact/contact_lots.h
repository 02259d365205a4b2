#pragma once

#include <cstddef>
#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Says that a particle may have a contact force, unless that may be any.
inline void mark_contact_lot(State& state, int particle) {
  if (!state.contact_lots.empty()) {
    state.contact_lots[static_cast<std::size_t>(particle) / State::kContactLot] = 1;
  }
}

/// The same of the particles of a pair that has come to touch.
void mark_contact_lots(const Scene& scene, State& state, int ball, int segment);

/// Lets go of the lots of pairs that have parted, if that is due every so many steps and one of the newest `steps` is it.
void renew_contact_lots(const Scene& scene, State& state, std::int64_t steps);

/// Whether one of some particles may have a contact force, by State::contact_lots; null: any may.
/// REQUIRES: no more than kContactLot of them.
inline bool may_bear_contact(const std::uint8_t* lots, std::size_t first, std::size_t count) {
  return lots == nullptr || (lots[first / State::kContactLot] | lots[(first + count - 1) / State::kContactLot]) != 0;
}

}  // namespace cellcrush
