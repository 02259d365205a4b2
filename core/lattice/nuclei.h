#pragma once

#include <cstdint>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// A place in whole units, so that the same seed gives the same nuclei whatever the machine.
struct GridPlace {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// Nuclei of a set that repeats along x and y.
struct Nuclei {
  GridPlace period;               ///< at most 2^28
  std::int64_t pitch = 0;         ///< between neighbours in a row of the regular set, d0
  std::vector<GridPlace> places;  ///< from 0 to below the period

  [[nodiscard]] GridPlace wrapped(GridPlace place) const {
    const auto wrap = [](std::int64_t value, std::int64_t by) { return ((value % by) + by) % by; };
    return {wrap(place.x, period.x), wrap(place.y, period.y)};
  }
};

/// The nuclei of a Voronoi honeycomb before any relaxation. They start on the regular set and are moved at random, each
/// fifty times, by up to `irregularity` times d0 in x and in y. A move is kept if no other nucleus is then closer than
/// (1 - irregularity) d0, of which up to two units are lost to rounding.
/// Placing nuclei one by one where there is room, as is usual, gives such sets as well, but only of irregularities
/// above 0.25: sets of less fill up first. REQUIRES: a checked lattice.
Nuclei place_nuclei(const VoronoiWalls& lattice);

}  // namespace cellcrush
