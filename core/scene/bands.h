#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "scene/face_loops.h"

namespace cellcrush {

/// Bands that may have particles at the same face of a lattice that is cut into bands.
inline constexpr int kBandsAtFace = 2;

/// All of a lattice.
LatticeBand whole_band(const Scene& scene);

/// Cuts a large lattice into bands so that a step of one has to do with its two neighbours only (step/advance_block.h):
///  - walls join particles of their band and of the one before;
///  - faces have particles of two neighbouring bands at most, and the elements at these particles are theirs or their
///    neighbours'.
/// Bands are as small as that allows. One where it does not, where the lattice is small, or where a step needs more than
/// walls, plates and contacts without friction.
std::vector<LatticeBand> cut_into_bands(const Scene& scene, const FaceLoops& loops);

/// Of every particle, the band that owns it.
std::vector<int> bands_of_particles(const Scene& scene, const std::vector<LatticeBand>& bands);

}  // namespace cellcrush
