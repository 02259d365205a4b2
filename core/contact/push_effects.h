#pragma once

#include <algorithm>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "contact/normal_force.h"

namespace cellcrush {

// What a push does, however its forces are added.

/// Force of a push's pair, of which the normal force is noted for friction; none where it has no pair.
inline NormalForce push_pair(const Scene& scene, const Touches& touches, Push& push) {
  if (!push.has_pair) {
    return {0.0, 0.0};
  }
  const NormalForce net = without_pull(scene.contact.stiffness * push.net_depth, touches.viscous[push.touch]);
  push.normal_force = net.elastic + net.viscous;
  return net;
}

/// Takes back half of what the touch of two balls would store: the node's ball counts the pair as well, and pushes on its
/// own where the node lies under the ball's segments.
inline void take_back_node(const Scene& scene, State& state, const Touches& touches, int node_touch) {
  const double stiffness = 0.5 * scene.contact.stiffness;
  const double depth = touches.node_depth[node_touch];
  const Vector2 force = stiffness * depth * touches.node_normal[node_touch];
  state.contact_force[state.touching.ball[node_touch]].elastic -= force;
  state.contact_force[touches.node[node_touch]].elastic += force;
  state.contact_stored -= 0.5 * stiffness * depth * depth;
}

/// Notes how deep a touch is, over the thinner of its walls, where that is a record.
inline void note_depth(const Scene& scene, State& state, const Touches& touches, int touch) {
  const double depth = touches.depth[touch];
  const bool is_new = touches.known[touch] == Touches::kNew;
  // Most are none, whatever their walls are.
  if (depth <= scene.contact.thinnest * (is_new ? state.deepest_birth : state.deepest_penetration)) {
    return;
  }
  const double thinner =
      std::min(2.0 * scene.radius[state.touching.ball[touch]], scene.elements[state.touching.segment[touch]].thickness);
  state.deepest_penetration = std::max(state.deepest_penetration, depth / thinner);
  if (is_new) {
    state.deepest_birth = std::max(state.deepest_birth, depth / thinner);
  }
}

/// What a push does beside its forces.
inline void note_push(const Scene& scene, State& state, const Touches& touches, const Push& push) {
  if (push.node_touch != Push::kNone) {
    take_back_node(scene, state, touches, push.node_touch);
  }
  note_depth(scene, state, touches, push.touch);
}

}  // namespace cellcrush
