#include <algorithm>
#include <span>
#include <utility>

#include "touch/contact_stages.h"
#include "touch/force_laws.h"

namespace cellcrush {
namespace {

/// Transfer of friction from one contact to the next.
struct Friction {
  const Scene& scene;
  const TouchMemory& touching;
  const Touches& touches;
  const TouchMemory& before;  ///< pairs that touched in the step before
  std::span<const ActiveContact> active;

  /// Whether a pair that touched before still has friction in this step.
  [[nodiscard]] bool has_friction(int earlier) const {
    const auto precedes = [&](const ActiveContact& contact, int memory) {
      return std::pair(touching.ball[contact.touch], touching.segment[contact.touch]) <
             std::pair(before.ball[memory], before.segment[memory]);
    };
    const auto found = std::lower_bound(active.begin(), active.end(), earlier, precedes);
    return found != active.end() && touches.known[found->touch] == earlier && found->has_pair;
  }

  /// Friction, along the polyline, of a touch of the ball in the step before that has no friction now and whose element
  /// satisfies `follows`.
  template <class Follows>
  [[nodiscard]] double ended_friction(int ball, const Follows& follows) const {
    const auto [first, end] = std::equal_range(before.ball.begin(), before.ball.end(), ball);
    for (auto at = first; at != end; ++at) {
      const auto earlier = static_cast<int>(at - before.ball.begin());
      if (before.pushed[earlier] != 0 && !has_friction(earlier) && follows(scene.elements[before.segment[earlier]])) {
        return before.friction[earlier] * before.pushed[earlier];
      }
    }
    return 0.0;
  }

  /// Friction with which a touch begins the step: its own, or that of a touch which it follows. A ball that slides to a
  /// neighbouring segment keeps its friction. Of two balls that touch, one hands it over to the other. Friction is
  /// measured along the polyline, in one direction on its left and in the other on its right.
  [[nodiscard]] double initial_friction(const ActiveContact& contact) const {
    const int ball = touching.ball[contact.touch];
    const int side = touching.side[contact.touch];
    const int known = touches.known[contact.touch];
    if (known != Touches::kNew && before.pushed[known] != 0) {
      return before.friction[known] * before.pushed[known] * side;
    }
    const Element& own = scene.elements[touching.segment[contact.touch]];
    const double of_neighbour = ended_friction(ball, [&](const Element& other) { return share_a_node(other, own); });
    if (of_neighbour != 0.0 || contact.node_touch == ActiveContact::kNone) {
      return of_neighbour * side;
    }
    return side * ended_friction(touches.node[contact.node_touch],
                                 [&](const Element& other) { return other.start == ball || other.end == ball; });
  }
};

}  // namespace

void apply_friction(const Scene& scene, State& state, TouchMemory& touching, const ContactWorkspace& workspace) {
  const Touches& touches = workspace.touches;
  touching.pushed.assign(touching.count(), 0);
  touching.friction.assign(touching.count(), 0.0);
  const Friction friction = {scene, touching, touches, workspace.before, workspace.active};
  for (const ActiveContact& contact : workspace.active) {
    const int touch = contact.touch;
    const int side = touching.side[touch];
    const double now = evaluate_friction(friction.initial_friction(contact), scene.contact.stiffness,
                                         touches.slip[touch], scene.contact.friction * contact.normal_force);
    touching.friction[touch] = now;
    touching.pushed[touch] = contact.has_pair ? side : 0;
    // Along the segment where the ball touches its side, turned with the normal round its ends. The nodes of the
    // segment share the reaction by the lever rule.
    const Vector2& normal = touches.normal[touch];
    const Vector2 force = now * side * Vector2(normal.y(), -normal.x());
    const double share = touches.share[touch];
    state.friction_force[touching.ball[touch]] += force;
    state.friction_force[touches.start[touch]] -= (1.0 - share) * force;
    state.friction_force[touches.end[touch]] -= share * force;
  }
}

}  // namespace cellcrush
