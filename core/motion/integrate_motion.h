#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/motion_works.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Positions along the crush outside which particles are noted, mm. By default none is.
struct NearRange {
  double below = -std::numeric_limits<double>::infinity();  ///< below it a ball may reach the impact plate
  double above = std::numeric_limits<double>::infinity();   ///< above it a ball may reach the support plate
};

/// Particles that are moved together, kParticlesMovedTogether at most, joints or particles inside walls.
struct MovedChunk {
  MotionWorks works;           ///< of the forces on them over the step
  std::size_t first = 0;       ///< particle
  std::size_t near_count = 0;  ///< of those that may be near a plate then
};

/// Chunks of a scene's free particles, those of joints first.
std::size_t moved_chunk_count(const Scene& scene);

/// The particles of such a chunk, from the first to the one after the last.
struct ParticleRange {
  std::size_t first = 0;
  std::size_t end = 0;
};
ParticleRange moved_chunk(const Scene& scene, std::size_t chunk);

/// How many particles of a band may be near a plate. They stand in a list with room for all particles, from the band's
/// first joint on, and from its first particle inside a wall, ascending.
struct NearCounts {
  std::size_t joints = 0;
  std::size_t inner = 0;
};

/// Central differences over one step of a band's free particles (E2): velocities to half a step after the forces,
/// positions and rotations to the next time. Clears the contact forces that moved the band's particles. Overwrites the
/// band's chunks among all of `moved`, and its part of the list `near_plates` by the particles that may be near a plate
/// then, whose `reach` is that at the step's end.
NearCounts integrate_motion(const Scene& scene, State& state, const LatticeBand& band, const NearRange& reach,
                            Workers& workers, std::vector<MovedChunk>& moved, std::vector<int>& near_plates);

}  // namespace cellcrush
