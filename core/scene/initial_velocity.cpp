#include "scene/initial_velocity.h"

#include <vector>

#include "scene/units.h"

namespace cellcrush {
namespace {

/// Gives velocities to the particles inside wall `w` of a block (E14b).
void move_inside(const WallBlock& block, int w, Scene& scene) {
  const int start = scene.walls.start[block.first_wall + w];
  const int end = scene.walls.end[block.first_wall + w];
  const Vector2 span = scene.position[end] - scene.position[start];
  const Vector2 across = normal_of(span);  // n L
  const Vector2& from = scene.initial_velocity[start];
  const Vector2& to = scene.initial_velocity[end];
  const double turn = across.dot(to - from) / span.squaredNorm();
  const double at_start = scene.initial_spin[start] - turn;
  const double at_end = scene.initial_spin[end] - turn;
  for (int j = 0; j + 1 < block.elements; ++j) {
    const double s = static_cast<double>(j + 1) / block.elements;
    const double r = 1.0 - s;
    const int i = block.first_inner + j * block.walls + w;
    scene.initial_velocity[i] = r * from + s * to + across * (s * r * (r * at_start - s * at_end));
    scene.initial_spin[i] = turn + r * (1.0 - 3.0 * s) * at_start + s * (3.0 * s - 2.0) * at_end;
  }
}

}  // namespace

void attach_initial_velocities(const FrameLattice& frame, Scene& scene) {
  if (frame.initial_velocities.empty()) {
    return;
  }
  scene.initial_velocity.assign(scene.particle_count(), Vector2::Zero());
  scene.initial_spin.assign(scene.particle_count(), 0.0);
  std::vector<bool> named(frame.nodes.size(), false);
  for (const FrameLattice::InitialVelocity& velocity : frame.initial_velocities) {
    scene.initial_velocity[velocity.node] = Vector2(velocity.x_m_per_s, velocity.y_m_per_s) * kMmPerM;
    scene.initial_spin[velocity.node] = velocity.rotation_rad_per_s;
    named[velocity.node] = true;
  }
  for (const WallBlock& block : scene.walls.blocks) {
    for (int w = 0; w < block.walls; ++w) {
      const int wall = block.first_wall + w;
      if (named[scene.walls.start[wall]] && named[scene.walls.end[wall]]) {
        move_inside(block, w, scene);
      }
    }
  }
}

}  // namespace cellcrush
