#include "touch/apply_friction.h"

#include <algorithm>
#include <span>

#include "touch/force_laws.h"

namespace cellcrush {
namespace {

/// Adds a force to the ball of a touch, and its reaction to the segment, shared by the lever rule.
void add_force(const TouchMemory& touching, const Touches& touches, int touch, const Vector2& force, Vector2* forces) {
  const double share = touches.share[touch];
  forces[touching.ball[touch]] += force;
  forces[touches.start[touch]] -= (1.0 - share) * force;
  forces[touches.end[touch]] -= share * force;
}

/// Unit tangent: along the segment where the ball touches its side, turned with the normal round its ends.
Vector2 tangent_of(const TouchMemory& touching, const Touches& touches, int touch) {
  const Vector2& normal = touches.normal[touch];
  return touching.side[touch] * Vector2(normal.y(), -normal.x());
}

/// Transfer of friction from one contact to the next.
struct Friction {
  const Scene& scene;
  const TouchMemory& touching;
  const Touches& touches;
  const TouchMemory& before;  ///< pairs that touched in the step before
  std::span<const ActiveContact> active;

  /// Whether a pair that touched before still has friction in this step.
  [[nodiscard]] bool still_rubs(int other) const {
    const auto precedes = [&](const ActiveContact& contact, int memory) {
      const int ball = touching.ball[contact.touch];
      return ball != before.ball[memory] ? ball < before.ball[memory]
                                         : touching.segment[contact.touch] < before.segment[memory];
    };
    const auto found = std::lower_bound(active.begin(), active.end(), other, precedes);
    return found != active.end() && touches.known[found->touch] == other && found->has_pair;
  }

  /// Friction, along the polyline, of a touch of the ball in the step before that has no friction now and whose element
  /// satisfies `follows`.
  template <class Follows>
  [[nodiscard]] double handed_over(int ball, const Follows& follows) const {
    const auto first = std::lower_bound(before.ball.begin(), before.ball.end(), ball);
    for (auto other = static_cast<int>(first - before.ball.begin());
         other < static_cast<int>(before.count()) && before.ball[other] == ball; ++other) {
      if (before.pushed[other] != 0 && !still_rubs(other) && follows(scene.elements[before.segment[other]])) {
        return before.friction[other] * before.pushed[other];
      }
    }
    return 0.0;
  }

  /// Friction with which a touch begins the step: its own, or that of a touch which it follows. A ball that slides to a
  /// neighbouring segment keeps its friction. Of two balls that touch, one hands it over to the other. Friction is
  /// measured along the polyline, in one direction on its left and in the other on its right.
  [[nodiscard]] double before_of(const ActiveContact& contact) const {
    const int ball = touching.ball[contact.touch];
    const int side = touching.side[contact.touch];
    const int known = touches.known[contact.touch];
    if (known != Touches::kNew && before.pushed[known] != 0) {
      return before.friction[known] * before.pushed[known] * side;
    }
    const Element& own = scene.elements[touching.segment[contact.touch]];
    const double of_neighbour = handed_over(ball, [&](const Element& other) { return share_a_node(other, own); });
    if (of_neighbour != 0.0 || contact.node_touch == ActiveContact::kNone) {
      return of_neighbour * side;
    }
    return side * handed_over(touches.node[contact.node_touch],
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
    const double now = evaluate_friction(friction.before_of(contact), scene.contact.stiffness,
                                         touches.slip[contact.touch], scene.contact.friction * contact.normal_force);
    touching.friction[contact.touch] = now;
    touching.pushed[contact.touch] = contact.has_pair ? touching.side[contact.touch] : 0;
    add_force(touching, touches, contact.touch, now * tangent_of(touching, touches, contact.touch),
              state.friction_force.data());
  }
}

}  // namespace cellcrush
