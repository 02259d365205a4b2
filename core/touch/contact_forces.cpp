#include "touch/contact_forces.h"

#include <algorithm>
#include <span>
#include <vector>

#include "search/candidate_lists.h"
#include "touch/contact_tiles.h"
#include "touch/evaluate_touches.h"
#include "touch/find_active_contacts.h"
#include "touch/find_overlaps.h"
#include "touch/friction.h"
#include "touch/normal_forces.h"
#include "touch/remember_touches.h"

namespace cellcrush {
namespace {

/// Of the touches from `touch` on, the first of a ball.
std::size_t begin_of_ball(const TouchMemory& touching, std::size_t touch) {
  while (touch > 0 && touch < touching.count() && touching.ball[touch - 1] == touching.ball[touch]) {
    ++touch;
  }
  return touch;
}

/// A released pair is tested again from the next step on, in the list that has it.
void wake(std::vector<ContactLists>& contacts, std::size_t band, int touch) {
  const TouchMemory& touching = contacts[band].touching;
  for (std::size_t home = band > 0 ? band - 1 : 0; home <= band; ++home) {
    wake_candidate(contacts[home], touching.place[touch], touching.ball[touch], touching.segment[touch]);
  }
}

/// Evaluates the touches and finds the active contacts, each thread those of its balls.
void evaluate_pairs(const Scene& scene, State& state, std::size_t band, ContactWorkspace& workspace, Workers& workers) {
  ContactLists& lists = state.contacts[band];
  const TouchMemory& touching = lists.touching;
  workers.share_parts(touching.count(), 1, [&](std::size_t p, std::size_t part_first, std::size_t part_end) {
    const std::size_t first = begin_of_ball(touching, part_first);
    const std::size_t end = begin_of_ball(touching, part_end);
    ContactPart& part = workspace.parts[p];
    evaluate_touches(scene, state, lists, workspace.touches, first, end, part.released);
    find_active_contacts(scene, state, lists, workspace.touches, first, end, part.active);
  });
  lists.released.clear();
  for (const ContactPart& part : workspace.parts) {
    for (const int i : part.released) {
      lists.released.push_back(i);
      wake(state.contacts, band, i);
    }
  }
  workspace.active.clear();
  if (workspace.parts.size() == 1) {
    workspace.active.swap(workspace.parts.front().active);
    return;
  }
  for (const ContactPart& part : workspace.parts) {
    workspace.active.insert(workspace.active.end(), part.active.begin(), part.active.end());
  }
}

/// Adds a force on a touch's ball, and its reaction on the segment, shared by the lever rule.
void add_force(const TouchMemory& touching, const Touches& touches, int touch, const Vector2& force, Vector2* forces) {
  const double share = touches.share[touch];
  forces[touching.ball[touch]] += force;
  forces[touches.start[touch]] -= (1.0 - share) * force;
  forces[touches.end[touch]] -= share * force;
}

/// Along the segment where the ball touches its side, turned with the normal round its ends.
Vector2 tangent_of(const TouchMemory& touching, const Touches& touches, int touch) {
  const Vector2& normal = touches.normal[touch];
  return touching.side[touch] * Vector2(normal.y(), -normal.x());
}

/// How friction passes from one contact to the next.
struct Friction {
  const Scene& scene;
  const TouchMemory& touching;
  const Touches& touches;
  const TouchMemory& before;  ///< what touched in the step before
  std::span<const ActiveContact> active;

  /// Whether a pair that touched before is active with friction in this step.
  [[nodiscard]] bool still_rubs(int other) const {
    const auto precedes = [&](const ActiveContact& contact, int memory) {
      const int ball = touching.ball[contact.touch];
      return ball != before.ball[memory] ? ball < before.ball[memory]
                                         : touching.segment[contact.touch] < before.segment[memory];
    };
    const auto found = std::lower_bound(active.begin(), active.end(), other, precedes);
    return found != active.end() && touches.known[found->touch] == other && found->has_pair;
  }

  /// Friction, along the polyline, of a touch of the ball in the step before that rubs no more and that
  /// `follows(element)`.
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

  /// Friction that a touch takes over: its own, or that of a touch which it follows. A ball slides on from a neighbour;
  /// of two balls the one hands over to the other. All run along the polyline, one way on its left and the other on its
  /// right.
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

/// Overwrites the friction of all that touch by that of the active contacts, and adds the forces.
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

}  // namespace

void evaluate_contact_forces(const Scene& scene, State& state, std::size_t band, ContactWorkspace& workspace,
                             Workers& workers, ContactSums& sums) {
  ContactLists& lists = state.contacts[band];
  workspace.parts.resize(static_cast<std::size_t>(workers.count()));
  find_overlaps(scene, state, lists, workspace, workers);
  remember_touches(scene, scene.bands[band], lists, workspace, sums.of_next_band);
  for (const NewContact& pair : workspace.new_contacts) {
    mark_contact_tiles(scene, state, pair.ball, pair.segment);
  }
  evaluate_pairs(scene, state, band, workspace, workers);
  apply_normal_forces(scene, state, lists.touching, workspace, sums.walls);
  sums.walls.count += static_cast<std::int64_t>(workspace.active.size());
  if (scene.contact.friction > 0.0) {
    apply_friction(scene, state, lists.touching, workspace);
  }
}

}  // namespace cellcrush
