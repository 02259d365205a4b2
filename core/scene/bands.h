#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"
#include "scene/face_loops.h"

namespace cellcrush {

/// Bands that may have particles at the same face of a lattice that is cut into bands.
inline constexpr int kBandsAtFace = 2;

/// Bands by which a step is behind the one before it where threads advance bands side by side (step/advance_block.h).
inline constexpr std::size_t kBandsBehind = 3;

/// What a step reads and writes of a band, bytes: of its elements, and what goes with them.
std::size_t bytes_of_band(const Scene& scene);

/// The first of the elements that a band's walls are divided into.
inline int first_element_of(const Scene& scene, const LatticeBand& band) {
  return scene.walls.blocks[scene.walls.chunk_offset[band.first_chunk]].first_element;
}

/// All of a lattice.
LatticeBand whole_band(const Scene& scene);

/// Cuts a large lattice into bands so that a step of one has to do with its two neighbours only (step/advance_block.h):
///  - walls join particles of their band and of the one before;
///  - faces have particles of two neighbouring bands at most, and the elements at these particles are theirs or their
///    neighbours'.
/// Bands are as small as that allows. One where the caches do not hold two steps' bands, as where rows are many
/// thousand elements long, where the lattice is small, or where a step needs more than walls, plates and contacts
/// without friction.
std::vector<LatticeBand> cut_into_bands(const Scene& scene, const FaceLoops& loops);

/// Of every particle, the band that owns it.
std::vector<int> bands_of_particles(const Scene& scene, const std::vector<LatticeBand>& bands);

}  // namespace cellcrush
