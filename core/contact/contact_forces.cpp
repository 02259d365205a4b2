#include "contact/contact_forces.h"

#include <algorithm>
#include <cmath>

#include "contact/capsule.h"
#include "contact/normal_force.h"

namespace cellcrush {
namespace {

/// A ball that touches a segment.
struct Touch {
  int segment;
  double share;    ///< of the foot along the segment: 0 at its start, 1 at its end
  double depth;    ///< D, mm
  double reach;    ///< distance at which they touch, mm
  Vector2 normal;  ///< from the segment to the ball
  bool is_new;     ///< did not touch in the step before
};

/// Looks whether a ball touches a candidate, and keeps the candidate's side up to date.
bool find_touch(const Scene& scene, const State& state, int ball, ContactCandidate& candidate, Touch& touch) {
  const Element& element = scene.elements[candidate.segment];
  const double length = state.length[candidate.segment];
  const Vector2& axis = state.axis[candidate.segment];
  const Projection foot = project(state.position[ball], state.position[element.start], axis, length);
  const double full_reach = scene.radius[ball] + 0.5 * element.thickness;
  const double distance_squared = foot.offset.squaredNorm();
  if (distance_squared >= full_reach * full_reach) {
    candidate.side = 0;
    return false;
  }
  double reach = full_reach;
  if (candidate.joint >= 0) {
    reach = std::min(reach, 0.5 * (state.position[ball] - state.position[candidate.joint]).norm());
  }
  const bool inside = foot.along > 0.0 && foot.along < length;
  const double signed_distance = cross(axis, foot.offset);
  const bool touched_before = candidate.side != 0;
  double distance = std::sqrt(distance_squared);
  if (inside) {
    const int side_now = signed_distance >= 0.0 ? 1 : -1;
    const int side = touched_before ? candidate.side : side_now;
    distance = side * signed_distance;
    touch.normal = side * normal_of(axis);
  } else {
    touch.normal = distance > 0.0 ? Vector2(foot.offset / distance) : normal_of(axis);
  }
  if (distance >= reach) {
    candidate.side = 0;
    return false;
  }
  if (!touched_before) {
    candidate.side = signed_distance >= 0.0 ? 1 : -1;
  }
  touch.segment = candidate.segment;
  touch.share = foot.along / length;
  touch.depth = reach - distance;
  touch.reach = full_reach;
  touch.is_new = !touched_before;
  return true;
}

bool share_a_node(const Element& a, const Element& b) {
  return a.start == b.start || a.start == b.end || a.end == b.start || a.end == b.end;
}

/// Whether another touching segment of the same polyline is nearer to the ball.
bool yields_to_neighbour(const Scene& scene, const std::vector<Touch>& touches, std::size_t index) {
  const Touch& touch = touches[index];
  for (std::size_t other = 0; other < touches.size(); ++other) {
    const bool deeper = touches[other].depth > touch.depth || (touches[other].depth == touch.depth && other < index);
    if (other != index && deeper &&
        share_a_node(scene.elements[touch.segment], scene.elements[touches[other].segment])) {
      return true;
    }
  }
  return false;
}

void apply_touch(const Scene& scene, State& state, int ball, const Touch& touch) {
  const Element& element = scene.elements[touch.segment];
  const double to_end = touch.share;
  const double to_start = 1.0 - touch.share;
  const Vector2 segment_velocity = to_start * state.velocity[element.start] + to_end * state.velocity[element.end];
  const double rate = touch.normal.dot(segment_velocity - state.velocity[ball]);
  const double inverse_mass = 1.0 / scene.mass[ball] + to_start * to_start / scene.mass[element.start] +
                              to_end * to_end / scene.mass[element.end];
  const NormalForce force =
      evaluate_normal_force(scene.contact.stiffness, scene.contact.damping_ratio, inverse_mass, touch.depth, rate);
  const Vector2 elastic = force.elastic * touch.normal;
  const Vector2 viscous = force.viscous * touch.normal;
  state.contact_force[ball] += elastic;
  state.contact_force[element.start] -= to_start * elastic;
  state.contact_force[element.end] -= to_end * elastic;
  state.contact_damping_force[ball] += viscous;
  state.contact_damping_force[element.start] -= to_start * viscous;
  state.contact_damping_force[element.end] -= to_end * viscous;
  state.contact_stored += 0.5 * scene.contact.stiffness * touch.depth * touch.depth;
  ++state.contact_count;
  const double relative_depth = touch.depth / touch.reach;
  state.deepest_penetration = std::max(state.deepest_penetration, relative_depth);
  if (touch.is_new) {
    state.deepest_birth = std::max(state.deepest_birth, relative_depth);
  }
}

}  // namespace

void evaluate_contact_forces(const Scene& scene, State& state) {
  if (!scene.contact.present) {
    return;
  }
  std::fill(state.contact_force.begin(), state.contact_force.end(), Vector2::Zero());
  std::fill(state.contact_damping_force.begin(), state.contact_damping_force.end(), Vector2::Zero());
  state.contact_stored = 0.0;
  state.contact_count = 0;
  std::vector<Touch> touches;
  const int balls = static_cast<int>(scene.particle_count());
  for (int ball = 0; ball < balls; ++ball) {
    touches.clear();
    Touch touch{};
    for (int k = state.candidate_offset[ball]; k < state.candidate_offset[ball + 1]; ++k) {
      if (find_touch(scene, state, ball, state.candidates[k], touch)) {
        touches.push_back(touch);
      }
    }
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (!yields_to_neighbour(scene, touches, i)) {
        apply_touch(scene, state, ball, touches[i]);
      }
    }
  }
}

}  // namespace cellcrush
