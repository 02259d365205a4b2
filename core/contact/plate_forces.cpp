#include "contact/plate_forces.h"

#include "contact/friction.h"
#include "contact/normal_force.h"

namespace cellcrush {

namespace {

/// The plates do not move across the crush, so a particle's slip is its own motion there.
void add_plate_friction(const Scene& scene, State& state) {
  const int across = 1 - scene.plates.axis;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const double slip = scene.schedule.time_step * state.velocity[i][across];
    const auto rub = [&](double normal_force, double& friction) {
      friction = evaluate_friction(friction, scene.plates.stiffness, slip, scene.plates.friction * normal_force);
      state.friction_force[i][across] += friction;
    };
    rub(state.impact_force[i] + state.impact_damping_force[i], state.impact_friction[i]);
    rub(state.support_force[i] + state.support_damping_force[i], state.support_friction[i]);
  }
}

}  // namespace

void evaluate_plate_forces(const Scene& scene, State& state) {
  const Plates& plates = scene.plates;
  if (!plates.present) {
    return;
  }
  const double impact_face = plates.impact_face + state.impact_travel;
  const double plate_speed = plates.speed_at(state.time - 0.5 * scene.schedule.time_step);
  const auto push = [&](std::size_t i, double depth, double rate, double& elastic, double& viscous) {
    const NormalForce force = depth > 0.0 ? evaluate_normal_force(plates.stiffness, scene.contact.damping_ratio,
                                                                  1.0 / scene.mass[i], depth, rate)
                                          : NormalForce{0.0, 0.0};
    elastic = force.elastic;
    viscous = force.viscous;
    state.contact_stored += 0.5 * force.elastic * (depth > 0.0 ? depth : 0.0);
  };
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const double place = state.position[i][plates.axis];
    const double speed = state.velocity[i][plates.axis];
    push(i, impact_face + scene.radius[i] - place, plate_speed - speed, state.impact_force[i],
         state.impact_damping_force[i]);
    push(i, place + scene.radius[i] - plates.support_face, speed, state.support_force[i],
         state.support_damping_force[i]);
  }
  if (plates.friction > 0.0) {
    add_plate_friction(scene, state);
  }
}

}  // namespace cellcrush
