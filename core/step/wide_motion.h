#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/plate_forces.h"
#include "parallel/workers.h"
#include "scene/bands.h"

namespace cellcrush {

// The free particles' part of integrate_motion and of evaluate_energies with the processor's vector instructions: the same
// equations as next_velocity and accumulate_work.

/// Sums over particles: the works of the forces on them, as the Ledger has them, and twice their kinetic energy, m v v'
/// with the velocities half a step before and after. N mm.
struct WorksOfMotion {
  double contact = 0.0;
  double contact_damping = 0.0;
  double friction = 0.0;
  double mass_damping = 0.0;
  double twice_kinetic = 0.0;

  void add(const WorksOfMotion& other) {
    contact += other.contact;
    contact_damping += other.contact_damping;
    friction += other.friction;
    mass_damping += other.mass_damping;
    twice_kinetic += other.twice_kinetic;
  }

  void book(Ledger& ledger) const {
    ledger.contact += contact;
    ledger.contact_damping += contact_damping;
    ledger.friction += friction;
    ledger.mass_damping += mass_damping;
  }
};

/// Particles that are moved together.
struct MovedChunk {
  WorksOfMotion works;
  std::size_t first = 0;       ///< particle
  std::size_t near_count = 0;  ///< of those that may be near a plate, in near_plates from `first` on
};

/// Chunks of so many joints, or of so many particles inside walls.
inline std::size_t moved_chunks(std::size_t particles) {
  return (particles + kParticlesMovedTogether - 1) / kParticlesMovedTogether;
}

/// Chunks of all particles, those of joints first.
inline std::size_t moved_chunk_count(const Scene& scene) {
  const auto joints = static_cast<std::size_t>(scene.joint_count);
  return moved_chunks(joints - static_cast<std::size_t>(scene.rigid.particle_count())) +
         moved_chunks(scene.particle_count() - joints);
}

/// Which of them are a band's.
struct MovedRanges {
  std::size_t first_of_joints;
  std::size_t end_of_joints;
  std::size_t first_of_inner;
  std::size_t end_of_inner;
};
MovedRanges moved_ranges_of(const Scene& scene, const LatticeBand& band);

/// Room for integrate_motion, kept from step to step so that none allocates.
struct MotionWorkspace {
  std::vector<MovedChunk> chunks;  ///< particles ascending
  std::vector<int> near_plates;    ///< room for all particles
};

/// Whether the scene is one of those without supports and loads that the two below know, and their text the one to use.
bool have_wide_motion(const Scene& scene);

/// Moves the free particles by a step, notes those that may be near a plate then, whose `reach` is that at the step's end, and
/// books the works. REQUIRES: have_wide_motion.
void move_particles_wide(const Scene& scene, State& state, const PlateReach& reach, MotionWorkspace& workspace,
                         Workers& workers);

/// The same of a band's particles. Overwrites the band's chunks among all, and behind each one's first place the particles that
/// may be near a plate; books nothing.
void move_band_of_particles_wide(const Scene& scene, State& state, const PlateReach& reach, const LatticeBand& band,
                                 MovedChunk* moved, int* near_plates);

/// The works of the newest forces over the half step up to the state's time, and the energy then. REQUIRES: have_wide_motion.
WorksOfMotion look_at_particles_wide(const Scene& scene, const State& state);

}  // namespace cellcrush
