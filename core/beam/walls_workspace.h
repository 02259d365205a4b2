#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cellcrush/lane_vector.h"

namespace cellcrush {

/// Values of an element that pass between the loops over its geometry, its fibres and its forces.
inline constexpr std::size_t kScratchKinds = 4;

/// Scratch of either precision of the fibres.
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

/// Room for the walls' part of a step, kept from step to step so that none allocates. No result depends on what it
/// holds.
struct WallsWorkspace {
  std::vector<WallScratch> of_thread;  ///< of a chunk at a time

  // Where all chunks are deformed before any responds.
  WallScratch all;                       ///< kScratchKinds E
  std::vector<std::uint8_t> compressed;  ///< C chunks, whether some elements have a modulus of their own
};

}  // namespace cellcrush
