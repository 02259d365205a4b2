#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"
#include "contact/topology/face_loops.h"

namespace cellcrush {

/// Bands by which a step follows the step before, where threads advance bands side by side (step/advance_wavefront.h).
inline constexpr std::size_t kBandsBehind = 3;

/// Bytes that a step reads and writes for a band: its elements and all data that belongs to them.
std::size_t bytes_of_band(const Scene& scene);

/// The whole lattice as one band.
LatticeBand whole_band(const Scene& scene);

/// Cuts a large lattice into bands so that a step of one interacts with its two neighbours only
/// (step/advance_wavefront.h):
///  - walls join particles of their own band and of the band before;
///  - a face has particles of at most two adjacent bands, and the elements at these particles belong to these bands or
///    their neighbours.
/// Bands are as small as these conditions allow, and, where the caches hold such bands, so deep that a crush does not
/// press those on either side of one together. The lattice stays a single band if
///  - it is small,
///  - the caches do not hold the bands of two steps, as for rows of many thousand elements,
///  - a step needs more than walls, plates and contacts without friction, or walls overlap before loading.
std::vector<LatticeBand> cut_into_bands(const Scene& scene, const std::vector<FaceLoop>& loops);

/// The band that owns each particle.
std::vector<int> bands_of_particles(const Scene& scene, const std::vector<LatticeBand>& bands);

/// The band of the wall of each element.
std::vector<int> bands_of_elements(const Scene& scene, const std::vector<LatticeBand>& bands);

}  // namespace cellcrush
