#include "contact/contact_forces.h"

#include <algorithm>
#include <cmath>

#include "contact/capsule.h"
#include "contact/friction.h"
#include "contact/normal_force.h"

namespace cellcrush {
namespace {

/// A ball that touches a segment.
struct Touch {
  int candidate;  ///< into the state's candidates
  int segment;
  double share;    ///< of the foot along the segment: 0 at its start, 1 at its end
  double depth;    ///< D, mm
  double reach;    ///< distance at which they touch, mm
  Vector2 normal;  ///< from the segment to the ball
  bool is_new;     ///< did not touch in the step before
};

/// Looks whether a ball touches a candidate, and keeps the candidate's side up to date.
bool find_touch(const Scene& scene, State& state, int ball, int index, Touch& touch) {
  ContactCandidate& candidate = state.candidates[index];
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
  touch.candidate = index;
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

/// Adds a force on the ball and its reaction on the segment, shared by the lever rule.
void add_pair(const Scene& scene, int ball, const Touch& touch, const Vector2& force, std::vector<Vector2>& forces) {
  const Element& element = scene.elements[touch.segment];
  forces[ball] += force;
  forces[element.start] -= (1.0 - touch.share) * force;
  forces[element.end] -= touch.share * force;
}

/// Friction that a ball brings along: that of the candidate itself, or of a neighbour that pushed until the step before and
/// from which the ball has slid on.
double friction_before(const Scene& scene, const State& state, int ball, const Touch& touch) {
  const ContactCandidate& own = state.candidates[touch.candidate];
  if (own.pushed != 0) {
    return own.friction;
  }
  for (int k = state.candidate_offset[ball]; k < state.candidate_offset[ball + 1]; ++k) {
    const ContactCandidate& other = state.candidates[k];
    if (other.pushed != 0 && share_a_node(scene.elements[touch.segment], scene.elements[other.segment])) {
      return other.friction * (state.axis[touch.segment].dot(state.axis[other.segment]) >= 0.0 ? 1.0 : -1.0);
    }
  }
  return 0.0;
}

/// Overwrites the friction of all candidates of a ball by that of the touches that push now, and adds the forces.
void apply_friction(const Scene& scene, State& state, int ball, const std::vector<Touch>& pushing,
                    const std::vector<double>& normal_force) {
  std::vector<double> friction;
  for (std::size_t i = 0; i < pushing.size(); ++i) {
    const Touch& touch = pushing[i];
    const Element& element = scene.elements[touch.segment];
    const Vector2 segment_velocity =
        (1.0 - touch.share) * state.velocity[element.start] + touch.share * state.velocity[element.end];
    const double slip =
        scene.schedule.time_step * (state.velocity[ball] - segment_velocity).dot(state.axis[touch.segment]);
    friction.push_back(evaluate_friction(friction_before(scene, state, ball, touch), scene.contact.stiffness, slip,
                                         scene.contact.friction * normal_force[i]));
  }
  for (int k = state.candidate_offset[ball]; k < state.candidate_offset[ball + 1]; ++k) {
    state.candidates[k].pushed = 0;
    state.candidates[k].friction = 0.0;
  }
  for (std::size_t i = 0; i < pushing.size(); ++i) {
    ContactCandidate& candidate = state.candidates[pushing[i].candidate];
    candidate.pushed = 1;
    candidate.friction = friction[i];
    add_pair(scene, ball, pushing[i], friction[i] * state.axis[candidate.segment], state.friction_force);
  }
}

/// Adds the normal force of a touch; returns its size in N.
double apply_touch(const Scene& scene, State& state, int ball, const Touch& touch) {
  const Element& element = scene.elements[touch.segment];
  const double to_end = touch.share;
  const double to_start = 1.0 - touch.share;
  const Vector2 segment_velocity = to_start * state.velocity[element.start] + to_end * state.velocity[element.end];
  const double rate = touch.normal.dot(segment_velocity - state.velocity[ball]);
  const double inverse_mass = 1.0 / scene.mass[ball] + to_start * to_start / scene.mass[element.start] +
                              to_end * to_end / scene.mass[element.end];
  const NormalForce force =
      evaluate_normal_force(scene.contact.stiffness, scene.contact.damping_ratio, inverse_mass, touch.depth, rate);
  add_pair(scene, ball, touch, force.elastic * touch.normal, state.contact_force);
  add_pair(scene, ball, touch, force.viscous * touch.normal, state.contact_damping_force);
  state.contact_stored += 0.5 * scene.contact.stiffness * touch.depth * touch.depth;
  ++state.contact_count;
  const double relative_depth = touch.depth / touch.reach;
  state.deepest_penetration = std::max(state.deepest_penetration, relative_depth);
  if (touch.is_new) {
    state.deepest_birth = std::max(state.deepest_birth, relative_depth);
  }
  return force.elastic + force.viscous;
}

}  // namespace

void evaluate_contact_forces(const Scene& scene, State& state) {
  std::fill(state.friction_force.begin(), state.friction_force.end(), Vector2::Zero());
  if (!scene.contact.present) {
    return;
  }
  std::fill(state.contact_force.begin(), state.contact_force.end(), Vector2::Zero());
  std::fill(state.contact_damping_force.begin(), state.contact_damping_force.end(), Vector2::Zero());
  state.contact_stored = 0.0;
  state.contact_count = 0;
  const bool has_friction = scene.contact.friction > 0.0;
  std::vector<Touch> touches;
  std::vector<Touch> pushing;
  std::vector<double> normal_force;
  const int balls = static_cast<int>(scene.particle_count());
  for (int ball = 0; ball < balls; ++ball) {
    touches.clear();
    pushing.clear();
    normal_force.clear();
    Touch touch{};
    for (int k = state.candidate_offset[ball]; k < state.candidate_offset[ball + 1]; ++k) {
      if (find_touch(scene, state, ball, k, touch)) {
        touches.push_back(touch);
      }
    }
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (!yields_to_neighbour(scene, touches, i)) {
        pushing.push_back(touches[i]);
        normal_force.push_back(apply_touch(scene, state, ball, touches[i]));
      }
    }
    if (has_friction && state.candidate_offset[ball] < state.candidate_offset[ball + 1]) {
      apply_friction(scene, state, ball, pushing, normal_force);
    }
  }
}

}  // namespace cellcrush
