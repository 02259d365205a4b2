#include "contact/find_touches.h"

#include <span>

#include "contact/candidate_lists.h"
#include "contact/capsule.h"
#include "contact/find_overlaps.h"

namespace cellcrush {
namespace {

/// What is remembered of the pairs: what was of those that touched before, nothing of the others. Both run by ball.
std::vector<ContactMemory> remember(const std::vector<Candidate>& pairs, const std::vector<ContactMemory>& before) {
  std::vector<ContactMemory> memories;
  memories.reserve(pairs.size());
  std::size_t next = 0;
  for (const Candidate& pair : pairs) {
    const auto precedes = [&](const ContactMemory& memory) {
      return memory.ball != pair.ball ? memory.ball < pair.ball : memory.segment < pair.segment;
    };
    while (next < before.size() && precedes(before[next])) {
      ++next;
    }
    const bool known = next < before.size() && before[next].ball == pair.ball && before[next].segment == pair.segment;
    memories.push_back(known ? before[next] : ContactMemory{pair.ball, pair.segment, 0, 0, 0.0});
  }
  return memories;
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

/// The touch of an overlapping pair; keeps its side up to date.
Touch touch_of(const Scene& scene, State& state, int index, double reach) {
  ContactMemory& memory = state.touching[index];
  const double length = state.length[memory.segment];
  const Vector2& axis = state.axis[memory.segment];
  const Projection foot =
      project(state.position[memory.ball], state.position[scene.elements[memory.segment].start], axis, length);
  const double signed_distance = cross(axis, foot.offset);
  const bool inside = foot.along > 0.0 && foot.along < length;
  const bool is_new = memory.side == 0;
  if (is_new || !inside) {
    // A ball that goes round an end comes to the other side by right.
    memory.side = signed_distance >= 0.0 ? 1 : -1;
  }
  double distance = memory.side * signed_distance;
  Vector2 normal = memory.side * normal_of(axis);
  if (!inside) {
    distance = foot.offset.norm();
    normal = distance > 0.0 ? Vector2(foot.offset / distance) : normal;
  }
  Touch touch;
  touch.memory = index;
  touch.ball = memory.ball;
  touch.segment = memory.segment;
  touch.share = foot.along / length;
  touch.reach = reach;
  touch.depth = reach - distance;
  touch.normal = normal;
  touch.is_new = is_new;
  return touch;
}

/// All touches, by ball.
std::vector<Touch> touches_of(const Scene& scene, State& state) {
  const std::vector<Candidate> pairs = find_overlaps(scene, state);
  state.touching = remember(pairs, state.touching);
  std::vector<Touch> touches;
  touches.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    touches.push_back(touch_of(scene, state, static_cast<int>(i), pairs[i].reach));
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
      const double depth = touch.reach - distance;
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
  pushing.reserve(touches.size());
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
