#pragma once

#include <cstddef>
#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// evaluate_touches with the processor's vector instructions, a pair a lane. Writes the pairs that have parted to `parted`,
/// ascending, and returns how many there are. REQUIRES: `parted` has room for all pairs and kSpareParted more.
std::size_t evaluate_touches_wide(const Scene& scene, State& state, Touches& touches, std::size_t first,
                                  std::size_t end, std::int64_t* parted);

/// Room that vectors may write over.
inline constexpr std::size_t kSpareParted = 8;

}  // namespace cellcrush
