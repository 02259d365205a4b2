#include "scene/initial_velocity.h"

#include <utility>
#include <vector>

namespace cellcrush {
namespace {

/// Rate at which the chord of a wall turns, rad/s.
double turn_of_chord(const Scene& scene, int wall) {
  const int start = scene.walls.start[wall];
  const int end = scene.walls.end[wall];
  const Vector2 span = scene.position[end] - scene.position[start];
  return normal_of(span).dot(scene.initial_velocity[end] - scene.initial_velocity[start]) / span.squaredNorm();
}

/// Moves the joints of pinned ends as their nodes, and turns them as the chords of their beams.
void move_pinned_ends(const FrameWalls& frame, std::vector<bool>& named, Scene& scene) {
  for (std::size_t pin = 0; pin < scene.pins.count(); ++pin) {
    const int node = scene.pins.joints_of(pin).front();
    for (const int joint : scene.pins.joints_of(pin)) {
      scene.initial_velocity[joint] = Vector2(scene.initial_velocity[node]);
      named[joint] = named[node];
    }
  }
  for (std::size_t wall = 0; wall < frame.beams.size(); ++wall) {
    const int start = scene.walls.start[wall];
    const int end = scene.walls.end[wall];
    for (const auto& [joint, is_pinned] :
         {std::pair(start, frame.beams[wall].pin_start), std::pair(end, frame.beams[wall].pin_end)}) {
      if (is_pinned && named[start] && named[end]) {
        scene.initial_spin[joint] = turn_of_chord(scene, static_cast<int>(wall));
      }
    }
  }
}

/// Gives velocities to the particles inside wall `w` of a block (E14b).
void move_inside(const WallBlock& block, int w, Scene& scene) {
  const int start = scene.walls.start[block.first_wall + w];
  const int end = scene.walls.end[block.first_wall + w];
  const Vector2 span = scene.position[end] - scene.position[start];
  const Vector2 across = normal_of(span);  // n L
  const Vector2& from = scene.initial_velocity[start];
  const Vector2& to = scene.initial_velocity[end];
  const double turn = turn_of_chord(scene, block.first_wall + w);
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

void attach_initial_velocities(const FrameWalls& frame, const std::vector<LoadsSpec::InitialVelocity>& velocities,
                               Scene& scene) {
  if (velocities.empty()) {
    return;
  }
  scene.initial_velocity.assign(scene.particle_count(), Vector2::Zero());
  scene.initial_spin.assign(scene.particle_count(), 0.0);
  std::vector<bool> named(static_cast<std::size_t>(scene.joint_count), false);
  for (const LoadsSpec::InitialVelocity& velocity : velocities) {
    scene.initial_velocity[velocity.node] = Vector2(velocity.x_m_per_s, velocity.y_m_per_s) * kMmPerM;
    scene.initial_spin[velocity.node] = velocity.rotation_rad_per_s;
    named[velocity.node] = true;
  }
  move_pinned_ends(frame, named, scene);
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
