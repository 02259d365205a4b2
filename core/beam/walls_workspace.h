#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cellcrush/lane_vector.h"

namespace cellcrush {

/// Values of an element that pass between the loops over its geometry, its fibres and its forces.
inline constexpr std::size_t kPassedKinds = 4;

/// Room for evaluate_internal_forces, kept from step to step so that none allocates. No result depends on what it holds.
struct WallsWorkspace {
  std::vector<double> plastic_work;  ///< C, of each chunk in this step

  // Where the first loop runs over all chunks before the others do.
  LaneVector<float> single_passed;     ///< kPassedKinds E, of fibres in single precision
  LaneVector<double> passed;           ///< the same, in double
  std::vector<std::uint8_t> squashed;  ///< C, whether some elements have a stiffness of their own

  template <class T>
  LaneVector<T>& passed_of() {
    if constexpr (std::is_same_v<T, float>) {
      return single_passed;
    } else {
      return passed;
    }
  }
};

}  // namespace cellcrush
