#include "touch/rigid_wall_forces.h"

#include "contact/thickening.h"
#include "touch/face_forces.h"

namespace cellcrush {
namespace {

Face face_of_wall(const Scene& scene, State& state, std::size_t wall) {
  const RigidWall& of = scene.rigid_walls[wall];
  const double step = scene.schedule.time_step;
  return {of.face_at(state.time),
          of.normal,
          of.tangent(),
          of.travel_between(state.time - step, state.time) / step,
          scene.contact.stiffness,
          of.friction,
          of.friction > 0.0 ? &state.rigid_wall_friction[wall * scene.particle_count()] : nullptr,
          !state.radius_growth.empty()};
}

}  // namespace

void evaluate_rigid_wall_forces(const Scene& scene, State& state, int first, int end, ContactSums& sums) {
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    const Face face = face_of_wall(scene, state, wall);
    RigidWallForce& of_wall = sums.rigid_walls[wall];
    for (int particle = first; particle < end; ++particle) {
      const double radius = radius_now(scene, state, particle);
      const bool rubbed = face.friction_of != nullptr && face.friction_of[particle] != 0.0;
      if (face.distance_of(state.position[particle]) < radius || rubbed) {
        const FaceForce force = push_by_face(scene, state, face, particle, radius);
        of_wall.normal.elastic += force.elastic;
        of_wall.normal.viscous += force.viscous;
        of_wall.tangential += force.tangential;
        sums.walls.stored += force.stored;
      }
    }
  }
}

}  // namespace cellcrush
