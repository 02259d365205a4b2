#include "contact/contact_forces.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "contact/capsule.h"
#include "contact/friction.h"
#include "contact/normal_force.h"

namespace cellcrush {
namespace {

/// A ball that touches a segment.
struct Touch {
  int candidate;  ///< into the state's candidates
  int ball;
  int segment;
  double share;    ///< of the foot along the segment: 0 at its start, 1 at its end
  double depth;    ///< D, mm
  Vector2 normal;  ///< from the segment to the ball
  bool is_new;     ///< did not touch in the step before
};

/// Candidates whose capsules overlap, ascending; all others forget their side. Few of the many do: a branch for each would
/// be guessed wrong too often, so the list is written by counting on.
std::vector<int> overlapping(const Scene& scene, State& state) {
  std::vector<int> found(state.candidates.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < state.candidates.size(); ++k) {
    ContactCandidate& candidate = state.candidates[k];
    const Projection foot =
        project(state.position[candidate.ball], state.position[scene.elements[candidate.segment].start],
                state.axis[candidate.segment], state.length[candidate.segment]);
    const int overlaps = static_cast<int>(foot.offset.squaredNorm() < candidate.reach * candidate.reach);
    candidate.side *= overlaps;
    found[count] = static_cast<int>(k);
    count += static_cast<std::size_t>(overlaps);
  }
  found.resize(count);
  return found;
}

/// The touch of an overlapping candidate; keeps its side up to date.
Touch touch_of(const Scene& scene, State& state, int index) {
  ContactCandidate& candidate = state.candidates[index];
  const double length = state.length[candidate.segment];
  const Vector2& axis = state.axis[candidate.segment];
  const Projection foot =
      project(state.position[candidate.ball], state.position[scene.elements[candidate.segment].start], axis, length);
  const double signed_distance = cross(axis, foot.offset);
  const bool inside = foot.along > 0.0 && foot.along < length;
  const bool is_new = candidate.side == 0;
  if (is_new || !inside) {
    // A ball that goes round an end comes to the other side by right.
    candidate.side = signed_distance >= 0.0 ? 1 : -1;
  }
  double distance = candidate.side * signed_distance;
  Vector2 normal = candidate.side * normal_of(axis);
  if (!inside) {
    distance = foot.offset.norm();
    normal = distance > 0.0 ? Vector2(foot.offset / distance) : normal;
  }
  return {index, candidate.ball, candidate.segment, foot.along / length, candidate.reach - distance, normal, is_new};
}

/// All touches, by ball.
std::vector<Touch> find_touches(const Scene& scene, State& state) {
  std::vector<Touch> touches;
  for (const int index : overlapping(scene, state)) {
    touches.push_back(touch_of(scene, state, index));
  }
  return touches;
}

bool share_a_node(const Element& a, const Element& b) {
  return a.start == b.start || a.start == b.end || a.end == b.start || a.end == b.end;
}

/// Whether another touching segment of the same polyline is nearer to the ball.
bool yields_to_neighbour(const Scene& scene, std::span<const Touch> touches_of_ball, std::size_t index) {
  const Touch& touch = touches_of_ball[index];
  for (std::size_t i = 0; i < touches_of_ball.size(); ++i) {
    const Touch& other = touches_of_ball[i];
    const bool deeper = other.depth > touch.depth || (other.depth == touch.depth && i < index);
    if (i != index && deeper && share_a_node(scene.elements[touch.segment], scene.elements[other.segment])) {
      return true;
    }
  }
  return false;
}

/// Of each ball's touches, those that push on it.
std::vector<Touch> pushing_of(const Scene& scene, const std::vector<Touch>& touches) {
  std::vector<Touch> pushing;
  for (std::size_t first = 0, last = 0; first < touches.size(); first = last) {
    while (last < touches.size() && touches[last].ball == touches[first].ball) {
      ++last;
    }
    const std::span<const Touch> touches_of_ball(&touches[first], last - first);
    for (std::size_t i = 0; i < touches_of_ball.size(); ++i) {
      if (!yields_to_neighbour(scene, touches_of_ball, i)) {
        pushing.push_back(touches_of_ball[i]);
      }
    }
  }
  return pushing;
}

/// Adds a force on the ball and its reaction on the segment, shared by the lever rule.
void add_pair(const Scene& scene, const Touch& touch, const Vector2& force, std::vector<Vector2>& forces) {
  const Element& element = scene.elements[touch.segment];
  forces[touch.ball] += force;
  forces[element.start] -= (1.0 - touch.share) * force;
  forces[element.end] -= touch.share * force;
}

/// Velocity of the segment where it touches the ball.
Vector2 segment_velocity(const Scene& scene, const State& state, const Touch& touch) {
  const Element& element = scene.elements[touch.segment];
  return (1.0 - touch.share) * state.velocity[element.start] + touch.share * state.velocity[element.end];
}

/// Adds the normal force of a touch; returns its size in N.
double apply_normal_force(const Scene& scene, State& state, const Touch& touch) {
  const Element& element = scene.elements[touch.segment];
  const double to_end = touch.share;
  const double to_start = 1.0 - touch.share;
  const double rate = touch.normal.dot(segment_velocity(scene, state, touch) - state.velocity[touch.ball]);
  const double inverse_mass = 1.0 / scene.mass[touch.ball] + to_start * to_start / scene.mass[element.start] +
                              to_end * to_end / scene.mass[element.end];
  const NormalForce force =
      evaluate_normal_force(scene.contact.stiffness, scene.contact.damping_ratio, inverse_mass, touch.depth, rate);
  add_pair(scene, touch, force.elastic * touch.normal, state.contact_force);
  add_pair(scene, touch, force.viscous * touch.normal, state.contact_damping_force);
  state.contact_stored += 0.5 * scene.contact.stiffness * touch.depth * touch.depth;
  ++state.contact_count;
  const double relative_depth = touch.depth / std::min(2.0 * scene.radius[touch.ball], element.thickness);
  state.deepest_penetration = std::max(state.deepest_penetration, relative_depth);
  if (touch.is_new) {
    state.deepest_birth = std::max(state.deepest_birth, relative_depth);
  }
  return force.elastic + force.viscous;
}

/// Along the segment where the ball touches its side, turned with the normal round its ends.
Vector2 tangent_of(const State& state, const Touch& touch) {
  const int side = state.candidates[touch.candidate].side;
  return side * Vector2(touch.normal.y(), -touch.normal.x());
}

/// Friction that a ball brings along: that of the candidate itself, or of a neighbour that pushed until the step before and
/// from which the ball has slid on. Both run along the polyline, the one way on its left and the other on its right.
double friction_before(const Scene& scene, const State& state, const Touch& touch) {
  const ContactCandidate& own = state.candidates[touch.candidate];
  if (own.pushed != 0) {
    return own.friction * own.pushed * own.side;
  }
  for (int k = state.candidate_offset[touch.ball]; k < state.candidate_offset[touch.ball + 1]; ++k) {
    const ContactCandidate& other = state.candidates[k];
    if (other.pushed != 0 && share_a_node(scene.elements[touch.segment], scene.elements[other.segment])) {
      return other.friction * other.pushed * own.side;
    }
  }
  return 0.0;
}

/// Overwrites the friction of all candidates by that of the touches that push now, and adds the forces.
void apply_friction(const Scene& scene, State& state, const std::vector<Touch>& pushing,
                    const std::vector<double>& normal_forces) {
  std::vector<double> friction;
  for (std::size_t i = 0; i < pushing.size(); ++i) {
    const Touch& touch = pushing[i];
    const Vector2 slide = state.velocity[touch.ball] - segment_velocity(scene, state, touch);
    const double slip = scene.schedule.time_step * slide.dot(tangent_of(state, touch));
    friction.push_back(evaluate_friction(friction_before(scene, state, touch), scene.contact.stiffness, slip,
                                         scene.contact.friction * normal_forces[i]));
  }
  for (ContactCandidate& candidate : state.candidates) {
    candidate.pushed = 0;
    candidate.friction = 0.0;
  }
  for (std::size_t i = 0; i < pushing.size(); ++i) {
    ContactCandidate& candidate = state.candidates[pushing[i].candidate];
    candidate.pushed = candidate.side;
    candidate.friction = friction[i];
    add_pair(scene, pushing[i], friction[i] * tangent_of(state, pushing[i]), state.friction_force);
  }
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
  const std::vector<Touch> pushing = pushing_of(scene, find_touches(scene, state));
  std::vector<double> normal_forces;
  for (const Touch& touch : pushing) {
    normal_forces.push_back(apply_normal_force(scene, state, touch));
  }
  if (scene.contact.friction > 0.0) {
    apply_friction(scene, state, pushing, normal_forces);
  }
}

}  // namespace cellcrush
