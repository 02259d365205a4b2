#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"
#include "step/wide_motion.h"

namespace cellcrush {

/// Sum of the forces on a particle, and of the moments; mass damping aside.
struct Resultant {
  Vector2 force;  ///< N
  double moment;  ///< N mm
};
Resultant resultant_on(const Scene& scene, const State& state, std::size_t particle);

/// Mass damping over a step: the part of a velocity that stays, and the time in which a force adds to it (E2).
struct DampedStep {
  double keep;
  double gain;  ///< s
};
DampedStep damped_step_of(const Scene& scene);

/// The first particle that belongs to no rigid body.
inline std::size_t first_free_particle(const Scene& scene) {
  return static_cast<std::size_t>(scene.rigid.particle_count());
}

/// Velocities of a particle half a step on, from those half a step back and the forces now (Eq. 4, central differences).
/// Mass damping -alpha m v acts on the mean of both, so that it is exact to second order and stable at any alpha.
struct NextVelocity {
  Vector2 velocity;                    ///< mm/s
  double spin;                         ///< rad/s
  Vector2 reaction = Vector2::Zero();  ///< N, of the supports
  double reaction_moment = 0.0;        ///< N mm
};
NextVelocity next_velocity(const Scene& scene, const State& state, const DampedStep& damped, std::size_t particle);

/// Lets go of the contacts' forces on a particle, which the step has used: those of the next step are added to 0.
inline void clear_contact_force(State& state, std::size_t particle) {
  state.contact_force[particle] = {};
  if (!state.friction_force.empty()) {
    state.friction_force[particle].setZero();
  }
}

/// What the impact plate does over a step, whatever the lattice does.
struct PlateStep {
  double displacement = 0.0;  ///< mm, over the time of the forces' work: half a step before and half a step after them
  double travel = 0.0;        ///< mm, at the step's end
};
PlateStep plate_step_of(const Scene& scene, double time, double travel);

/// Books the work and the impulses of the plates' forces over a step, and moves the impact plate.
void book_plates(const Scene& scene, const PlateStep& plates, State& state);

/// A state with particles in place, at the scene's initial velocities, without forces.
State place_particles(const Scene& scene);

/// Moves the velocities from time 0 to half a step before it, with the forces at time 0.
void stagger_velocities(const Scene& scene, State& state);

/// Central differences over one step: velocities to half a step on, positions, rotations and the impact plate to the next
/// time. Books the work of every force over the step in the ledger and the plates' impulses, and clears the contacts' forces.
/// Returns the particles that may be near a plate then.
NearPlates integrate_motion(const Scene& scene, State& state, MotionWorkspace& workspace, Workers& workers);

}  // namespace cellcrush
