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
inline void take_back_node(const Scene& scene, State& state, const TouchMemory& touching, const Touches& touches,
                           int node_touch, double& stored) {
  const double stiffness = 0.5 * scene.contact.stiffness;
  const double depth = touches.node_depth[node_touch];
  const Vector2 force = stiffness * depth * touches.node_normal[node_touch];
  state.contact_force[touching.ball[node_touch]].elastic -= force;
  state.contact_force[touches.node[node_touch]].elastic += force;
  stored -= 0.5 * stiffness * depth * depth;
}

/// Notes how deep touches are, over the thinner of their walls, where that is a record.
class DepthRecords {
 public:
  DepthRecords(const Scene& scene, const TouchMemory& touching, const Touches& touches, ContactTotals& totals)
      : scene_(scene),
        touching_(touching),
        totals_(totals),
        depth_(touches.depth.data()),
        known_(touches.known.data()) {
    set_bars();
  }

  /// Most are none, whatever their walls are.
  void note(int touch) {
    const bool is_new = known_[touch] == Touches::kNew;
    if (depth_[touch] > (is_new ? birth_bar_ : penetration_bar_)) {
      raise(touch, is_new);
    }
  }

 private:
  void raise(int touch, bool is_new) {
    const double thinner =
        std::min(2.0 * scene_.radius[touching_.ball[touch]], scene_.elements[touching_.segment[touch]].thickness);
    const double depth = depth_[touch] / thinner;
    totals_.deepest_penetration = std::max(totals_.deepest_penetration, depth);
    if (is_new) {
      totals_.deepest_birth = std::max(totals_.deepest_birth, depth);
    }
    set_bars();
  }

  void set_bars() {
    birth_bar_ = scene_.contact.thinnest * totals_.deepest_birth;
    penetration_bar_ = scene_.contact.thinnest * totals_.deepest_penetration;
  }

  const Scene& scene_;
  const TouchMemory& touching_;
  ContactTotals& totals_;
  const double* const depth_;
  const int* const known_;
  double birth_bar_ = 0.0;        ///< mm, that a touch must exceed in its first step
  double penetration_bar_ = 0.0;  ///< mm, in a later one
};

}  // namespace cellcrush
