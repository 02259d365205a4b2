#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "step/integrate_motion.h"

namespace cellcrush {

// Rigid bodies: their particles keep their places in the body, whose centre and turn go by the sums of the forces and of
// the moments about the centre, M dV/dt = sum F, I d(omega)/dt = sum (m + r x F), in the central differences of the
// particles (E2).

/// Velocities of a body half a step on.
NextVelocity next_velocity_of_body(const Scene& scene, const State& state, std::size_t body);

/// Calls visit(particle, its NextVelocity) for the particles of a body that moves on at `next`.
template <class Visit>
void visit_body(const Scene& scene, const State& state, std::size_t body, const NextVelocity& next, Visit&& visit) {
  for (int i = scene.rigid.offset[body]; i < scene.rigid.offset[body + 1]; ++i) {
    const Vector2 arm = state.position[i] - state.rigid_centre[body];
    visit(static_cast<std::size_t>(i), NextVelocity{next.velocity + next.spin * normal_of(arm), next.spin});
  }
}

/// Puts the bodies where they are before loading, at rest.
void place_rigid_bodies(const Scene& scene, State& state);

/// Moves the bodies' velocities from time 0 to half a step before it, with the forces at time 0.
void stagger_rigid_bodies(const Scene& scene, State& state);

/// Moves the bodies, their particles and the axes of their walls by a step, and books the work of the forces on them.
void move_rigid_bodies(const Scene& scene, State& state);

}  // namespace cellcrush
