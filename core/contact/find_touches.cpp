#include "contact/find_touches.h"

#include <span>

#include "contact/capsule.h"

namespace cellcrush {
namespace {

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

/// Whether the ball lies before the node's own ball, and not above the side of one of its segments.
bool lies_before(const Scene& scene, const State& state, int ball, int node) {
  const Vector2 away = state.position[ball] - state.position[node];
  for (int k = scene.incidence_offset[node]; k < scene.incidence_offset[node + 1]; ++k) {
    const int e = scene.incidence[k];
    const bool begins = scene.elements[e].start == node;
    const int other = begins ? scene.elements[e].end : scene.elements[e].start;
    if (other != ball && (begins ? 1.0 : -1.0) * state.axis[e].dot(away) > 0.0) {
      return false;
    }
  }
  return true;
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
  Touch touch;
  touch.candidate = index;
  touch.ball = candidate.ball;
  touch.segment = candidate.segment;
  touch.share = foot.along / length;
  touch.depth = candidate.reach - distance;
  touch.normal = normal;
  touch.is_new = is_new;
  return touch;
}

/// All touches, by ball.
std::vector<Touch> touches_of(const Scene& scene, State& state) {
  std::vector<Touch> touches;
  for (const int index : overlapping(scene, state)) {
    touches.push_back(touch_of(scene, state, index));
  }
  return touches;
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

/// Notes the nearest node of the polyline to which the pushing segment belongs.
void find_node(const Scene& scene, const State& state, std::span<const Touch> touches_of_ball, Touch& pushing) {
  for (const Touch& touch : touches_of_ball) {
    const Element& element = scene.elements[touch.segment];
    if (!share_a_node(element, scene.elements[pushing.segment])) {
      continue;
    }
    for (const int node : {element.start, element.end}) {
      const Vector2 away = state.position[touch.ball] - state.position[node];
      const double distance = away.norm();
      const double depth = state.candidates[touch.candidate].reach - distance;
      if (depth > pushing.node_depth && distance > 0.0) {
        pushing.node = node;
        pushing.node_depth = depth;
        pushing.node_normal = away / distance;
      }
    }
  }
}

/// Divides the normal force between the touch and that of the node's ball on the ball's own segments.
void share_with_node(const Scene& scene, const State& state, Touch& touch) {
  const Element& element = scene.elements[touch.segment];
  touch.net_depth = touch.depth;
  if (touch.share > 0.0 && touch.share < 1.0) {
    if (touch.node >= 0 && !lies_before(scene, state, touch.node, touch.ball)) {
      touch.net_depth -= 0.5 * touch.node_depth * touch.normal.dot(touch.node_normal);
    }
    return;
  }
  // Two balls touch: the first of them has the pair, or the one that lies over the other's segments.
  const int end = touch.share > 0.0 ? element.end : element.start;
  touch.has_pair = touch.ball < end && lies_before(scene, state, end, touch.ball);
  touch.net_depth = touch.has_pair ? touch.depth : 0.0;
}

}  // namespace

std::vector<Touch> find_touches(const Scene& scene, State& state) {
  const std::vector<Touch> touches = touches_of(scene, state);
  std::vector<Touch> pushing;
  for (std::size_t first = 0, last = 0; first < touches.size(); first = last) {
    while (last < touches.size() && touches[last].ball == touches[first].ball) {
      ++last;
    }
    const std::span<const Touch> touches_of_ball(&touches[first], last - first);
    for (std::size_t i = 0; i < touches_of_ball.size(); ++i) {
      if (!yields_to_neighbour(scene, touches_of_ball, i)) {
        pushing.push_back(touches_of_ball[i]);
        find_node(scene, state, touches_of_ball, pushing.back());
        share_with_node(scene, state, pushing.back());
      }
    }
  }
  return pushing;
}

}  // namespace cellcrush
