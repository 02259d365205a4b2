#include "step/rigid_motion.h"

#include <cmath>

#include "energy/ledger.h"

namespace cellcrush {

NextVelocity next_velocity_of_body(const Scene& scene, const State& state, std::size_t body) {
  Resultant sum = {Vector2::Zero(), 0.0};
  for (int i = scene.rigid.offset[body]; i < scene.rigid.offset[body + 1]; ++i) {
    const Resultant on_particle = resultant_on(scene, state, static_cast<std::size_t>(i));
    sum.force += on_particle.force;
    sum.moment += on_particle.moment + cross(state.position[i] - state.rigid_centre[body], on_particle.force);
  }
  const auto [keep, gain] = damped_step_of(scene);
  return {keep * state.rigid_velocity[body] + gain / scene.rigid.mass[body] * sum.force,
          keep * state.rigid_spin[body] + gain / scene.rigid.inertia[body] * sum.moment};
}

void place_rigid_bodies(const Scene& scene, State& state) {
  const std::size_t count = scene.rigid.count();
  state.rigid_centre = scene.rigid.centre;
  state.rigid_velocity.assign(count, Vector2::Zero());
  state.rigid_rotation.assign(count, 0.0);
  state.rigid_spin.assign(count, 0.0);
}

void stagger_rigid_bodies(const Scene& scene, State& state) {
  for (std::size_t body = 0; body < scene.rigid.count(); ++body) {
    const NextVelocity next = next_velocity_of_body(scene, state, body);
    state.rigid_velocity[body] -= 0.5 * (next.velocity - state.rigid_velocity[body]);
    state.rigid_spin[body] -= 0.5 * (next.spin - state.rigid_spin[body]);
    visit_body(scene, state, body, {state.rigid_velocity[body], state.rigid_spin[body]},
               [&](std::size_t i, const NextVelocity& of_particle) {
                 state.velocity[i] = of_particle.velocity;
                 state.spin[i] = of_particle.spin;
               });
  }
}

void move_rigid_bodies(const Scene& scene, State& state) {
  const RigidBodies& rigid = scene.rigid;
  const double step = scene.schedule.time_step;
  for (std::size_t body = 0; body < rigid.count(); ++body) {
    const NextVelocity next = next_velocity_of_body(scene, state, body);
    state.rigid_velocity[body] = next.velocity;
    state.rigid_spin[body] = next.spin;
    state.rigid_centre[body] += step * next.velocity;
    state.rigid_rotation[body] += step * next.spin;
    const double cosine = std::cos(state.rigid_rotation[body]);
    const double sine = std::sin(state.rigid_rotation[body]);
    for (int i = rigid.offset[body]; i < rigid.offset[body + 1]; ++i) {
      const Vector2 arm = scene.position[i] - rigid.centre[body];
      const Vector2 place = state.rigid_centre[body] + cosine * arm + sine * normal_of(arm);
      // The chord of the step, so that works and contacts go by how far the particle came.
      const NextVelocity of_particle = {(place - state.position[i]) / step, next.spin};
      accumulate_work(
          scene, state, static_cast<std::size_t>(i), of_particle,
          {0.5 * step * (state.velocity[i] + of_particle.velocity), 0.5 * step * (state.spin[i] + next.spin)},
          state.ledger);
      state.velocity[i] = of_particle.velocity;
      state.spin[i] = next.spin;
      state.position[i] = place;
      state.rotation[i] = state.rigid_rotation[body];
      clear_contact_force(state, static_cast<std::size_t>(i));
    }
  }
  if (rigid.count() > 0) {
    for (std::size_t e = static_cast<std::size_t>(rigid.first_element); e < scene.element_count(); ++e) {
      const Element& element = scene.elements[e];
      state.axis[e] = (state.position[element.end] - state.position[element.start]) * state.inverse_length[e];
    }
  }
}

}  // namespace cellcrush
