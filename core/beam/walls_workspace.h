#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cellcrush/lane_vector.h"

namespace cellcrush {

/// Values per element that are passed between the loops over geometry, fibres and forces.
inline constexpr std::size_t kScratchKinds = 4;

/// Scratch in either precision of the fibres.
struct WallScratch {
  LaneVector<float> in_single;
  LaneVector<double> in_double;

  template <class T>
  LaneVector<T>& of() {
    if constexpr (std::is_same_v<T, float>) {
      return in_single;
    } else {
      return in_double;
    }
  }
};

/// Scratch for the walls, kept from step to step so that no step allocates. No result depends on its contents.
struct WallsWorkspace {
  std::vector<WallScratch> of_thread;  ///< one chunk at a time

  // For steps that deform all chunks before any of them responds.
  WallScratch all;  ///< kScratchKinds E
  /// C chunks, 1 if any of the elements is squashed, so that its modulus is reduced.
  std::vector<std::uint8_t> squashed;
};

}  // namespace cellcrush
