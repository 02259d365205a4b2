#pragma once

// The phases of contacts between walls and at plates; see motion_phases-inl.h.

#include <cmath>
#include <cstddef>

#include "contact/touch/active_contacts-inl.h"
#include "contact/touch/evaluate_touches-inl.h"
#include "contact/touch/friction-inl.h"
#include "contact/touch/normal_forces-inl.h"
#include "contact/touch/overlap-inl.h"
#include "device/added_forces-inl.h"
#include "device/atomics-inl.h"
#include "device/crush-inl.h"
#include "push/press_ball-inl.h"

namespace cellcrush::HWY_NAMESPACE {

/// The contacts of a ball in this step, in the memory of the thread.
class BallContacts {
 public:
  HWY_INLINE BallContacts(Crush& crush, int ball)
      : first_(static_cast<std::size_t>(ball) * kMostTouches), lists_(), touches_() {
    lists_.reach_growth = crush.state.radius_growth.empty() ? 0.0 : 1.0;
  }

  /// Place of the touches among those of all balls.
  [[nodiscard]] HWY_INLINE std::size_t first() const { return first_; }
  [[nodiscard]] HWY_INLINE int* known() { return known_; }
  [[nodiscard]] HWY_INLINE ContactLists& lists() { return lists_; }
  [[nodiscard]] HWY_INLINE Touches& touches() { return touches_; }

  /// Evaluates that many touches.
  HWY_INLINE void evaluate(const Crush& crush, int touches) {
    const auto count = static_cast<std::size_t>(touches);
    lists_.touching = {{&crush.touch_ball[first_], count},  {&crush.touch_segment[first_], count},
                       {&crush.touch_reach[first_], count}, {&crush.touch_linked[first_], count},
                       {&crush.touch_side[first_], count},  part(crush.touch_pushed, count),
                       part(crush.touch_friction, count)};
    touches_ = {{start_, count}, {end_, count},   {known_, count},      {growth_, count},     {offset_, count},
                {share_, count}, {depth_, count}, {nullptr, 0},         {normal_, count},     {viscous_, count},
                {slip_, count},  {node_, count},  {node_depth_, count}, {node_normal_, count}};
    const PairArrays arrays = {crush.scene, crush.state, lists_, touches_};
    for (std::size_t i = 0; i < count; ++i) evaluate_pairs<One>(arrays, i);
  }

 private:
  /// Those of the ball, of an array that may be empty.
  template <class T>
  [[nodiscard]] HWY_INLINE Array<T> part(const Array<T>& array, std::size_t count) const {
    return array.empty() ? array : Array<T>{array.values + first_, count};
  }

  std::size_t first_;
  ContactLists lists_;
  Touches touches_;
  int start_[kMostTouches];
  int end_[kMostTouches];
  int known_[kMostTouches];
  double growth_[kMostTouches];
  double offset_[kMostTouches];
  double share_[kMostTouches];
  double depth_[kMostTouches];
  Vector2 normal_[kMostTouches];
  double viscous_[kMostTouches];
  double slip_[kMostTouches];
  int node_[kMostTouches];
  double node_depth_[kMostTouches];
  Vector2 node_normal_[kMostTouches];
};

/// The contacts of a ball: those that it had and still has, and those that begin; their normal forces, and what plates
/// do to it.
class EvaluateContacts {
 public:
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.first_added.size(); }

  static HWY_INLINE void compute(Crush& crush, std::size_t item, std::size_t step) {
    const int ball = static_cast<int>(item);
    ForceList forces(crush, ball);
    AddingState state{crush.state, forces};
    if (crush.scene.contact.present) touch(crush, state, ball);
    forces.begin_plates();
    press(crush, state, ball, crush.plate_steps[step]);
  }

 private:
  static HWY_INLINE void touch(Crush& crush, AddingState& state, int ball) {
    crush.active_count[ball] = 0;
    if (!crush.before_count.empty()) keep_friction(crush, ball);
    BallContacts contacts(crush, ball);
    const int kept = drop_released(crush, ball, contacts.known());
    const int count = crush.candidate_count[ball] == 0 ? kept : add_new(crush, ball, kept, contacts.known());
    crush.touch_count[ball] = count;
    if (count == 0) return;
    contacts.evaluate(crush, count);
    link(crush.scene, contacts.lists().touching);
    const TouchArrays of = {contacts.lists().touching, contacts.touches()};
    ContactTotals deepest;
    for (int i = 0; i < count; ++i) {
      const std::size_t at = contacts.first() + i;
      crush.touch_squared_depth[at] = 0.0;
      crush.touch_stored[at] = 0.0;
      ActiveContact contact;
      if (!is_active(crush.scene, crush.state, contacts.lists(), contacts.touches(), i, contact)) continue;
      ++crush.active_count[ball];
      ContactTotals totals = deepest;
      totals.stored = 0.0;
      add_normal_force(crush.scene, state, state.contact_force, of, contact, crush.touch_squared_depth[at], totals);
      crush.touch_stored[at] = totals.stored;
      deepest = totals;
      const int known = contacts.known()[i];
      if (!crush.before_count.empty() && contact.has_pair && known != Touches::kNew) crush.before_goes_on[known] = 1;
    }
    if (!crush.before_count.empty()) {
      for (int i = 0; i < count; ++i) crush.touch_known[contacts.first() + i] = contacts.known()[i];
    }
    raise_at(crush.totals[0].deepest_penetration, deepest.deepest_penetration);
    raise_at(crush.totals[0].deepest_birth, deepest.deepest_birth);
  }

  /// Keeps what the friction of this step begins with.
  static HWY_INLINE void keep_friction(Crush& crush, int ball) {
    const std::size_t at = static_cast<std::size_t>(ball) * kMostTouches;
    crush.before_count[ball] = crush.touch_count[ball];
    for (std::size_t i = at; i < at + crush.touch_count[ball]; ++i) {
      crush.before_segment[i] = crush.touch_segment[i];
      crush.before_pushed[i] = crush.touch_pushed[i];
      crush.before_friction[i] = crush.touch_friction[i];
      crush.before_goes_on[i] = 0;
    }
  }

  /// Removes the pairs that were released in the step before. Returns how many are left.
  static HWY_INLINE int drop_released(Crush& crush, int ball, int* known) {
    const int count = crush.touch_count[ball];
    const std::size_t at = static_cast<std::size_t>(ball) * kMostTouches;
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      if (crush.touch_side[at + i] == 0) continue;
      known[kept] = static_cast<int>(at) + i;
      move_touch(crush, at + i, at + kept++);
    }
    return kept;
  }

  static HWY_INLINE void move_touch(Crush& crush, std::size_t from, std::size_t to) {
    crush.touch_segment[to] = crush.touch_segment[from];
    crush.touch_reach[to] = crush.touch_reach[from];
    crush.touch_side[to] = crush.touch_side[from];
  }

  /// Adds the candidates that have begun to overlap, by segment. Returns how many pairs there are.
  static HWY_INLINE int add_new(Crush& crush, int ball, int count, int* known) {
    const std::size_t at = static_cast<std::size_t>(ball) * kMostTouches;
    const int candidates = std::min<int>(crush.candidate_count[ball], +kMostCandidates);
    for (int k = 0; k < candidates; ++k) {
      const int segment = crush.candidate[ball * kMostCandidates + k];
      int place = 0;
      while (place < count && crush.touch_segment[at + place] < segment) ++place;
      if (place < count && crush.touch_segment[at + place] == segment) continue;  // it touches, or is listed twice
      const double reach = reach_now(crush.scene, crush.state, ball, segment);
      if (!overlaps(crush, ball, segment, reach)) continue;
      if (count == kMostTouches) {
        crush.totals[0].overflow = 1;
        break;
      }
      for (int i = count; i > place; --i) {
        move_touch(crush, at + i - 1, at + i);
        known[i] = known[i - 1];
      }
      crush.touch_segment[at + place] = segment;
      crush.touch_reach[at + place] = reach;
      crush.touch_side[at + place] = 0;
      known[place] = Touches::kNew;
      ++count;
    }
    return count;
  }

  static HWY_INLINE bool overlaps(const Crush& crush, int ball, int segment, double reach) {
    const State& state = crush.state;
    const GrownReach now =
        state.radius_growth.empty() ? GrownReach{reach, 0.0} : grown_reach(crush.scene, state, ball, segment, reach);
    const Element& ends = crush.scene.elements[segment];
    return all(overlap(relative_position<One>(Points<One>::load(&state.position[ball]),
                                              Points<One>::load(&state.position[ends.start]),
                                              Points<One>::load(&state.position[ends.end]), now.at_start, now.taper)));
  }

  /// Notes which pairs have segments that share a node.
  static HWY_INLINE void link(const Scene& scene, const TouchMemory& touching) {
    const int count = static_cast<int>(touching.count());
    for (int i = 0; i < count; ++i) {
      int linked = 0;
      for (int j = 0; j < count; ++j) {
        const bool joined =
            j != i && share_a_node(scene.elements[touching.segment[i]], scene.elements[touching.segment[j]]);
        linked |= joined ? 1 : 0;
      }
      touching.linked[i] = linked;
    }
  }

  static HWY_INLINE double distance_of(const Face& face, const Vector2& place) {
    return face.normal.dot(place - face.point);
  }

  /// See push_by_face of push/push.h.
  static HWY_INLINE FaceForce push(const Crush& crush, AddingState& state, const Face& face, int ball, double radius,
                                   double inverse_mass) {
    const double distance = distance_of(face, crush.state.position[ball]);
    FaceForce sum = press_ball(crush.scene, state, face, ball, radius - distance, inverse_mass);
    if (face.friction_of != nullptr && (distance < radius || face.friction_of[ball] != 0.0)) {
      sum.tangential = rub(crush.scene, state, face, ball, distance, face.friction * (sum.elastic + sum.viscous));
    }
    return sum;
  }

  /// Forces of the plates on a ball (push/plates.cpp).
  static HWY_INLINE void press(Crush& crush, AddingState& state, int ball, const PlateStep& plates) {
    const double radius = radius_now(crush.scene, crush.state, ball);
    const int axis = crush.scene.plates.axis;
    const double place = crush.state.position[ball][axis];
    Face impact = crush.impact;
    impact.point[axis] += plates.travel;
    impact.speed = plates.speed;
    const bool rubs = impact.friction_of != nullptr;
    const bool rubbed = rubs && (impact.friction_of[ball] != 0.0 || crush.support.friction_of[ball] != 0.0);
    if (!(place - radius < impact.point[axis] || place + radius > crush.support.point[axis] || rubbed)) return;
    const double inverse_mass = crush.scene.inverse_mass[ball];
    crush.plate_push[ball].impact = push(crush, state, impact, ball, radius, inverse_mass);
    crush.plate_push[ball].support = push(crush, state, crush.support, ball, radius, inverse_mass);
    or_at(crush.pressed[ball / 32], 1U << (ball % 32));
  }
};

/// Friction of the contacts of a ball. A phase of its own: it looks at the touches that other balls had and have.
class RubContacts {
 public:
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.before_count.size(); }

  static HWY_INLINE void compute(Crush& crush, std::size_t item, std::size_t /*step*/) {
    const int count = crush.touch_count[item];
    if (count == 0) return;
    const int ball = static_cast<int>(item);
    BallContacts contacts(crush, ball);
    unsigned released = 0;  // bits
    for (int i = 0; i < count; ++i) {
      const std::size_t at = contacts.first() + i;
      contacts.known()[i] = crush.touch_known[at];
      crush.touch_pushed[at] = 0;
      crush.touch_friction[at] = 0.0;
      released |= crush.touch_side[at] == 0 ? 1U << i : 0U;
    }
    if (crush.active_count[ball] == 0) return;
    contacts.evaluate(crush, count);
    for (int i = 0; i < count; ++i) {
      if ((released >> i & 1U) == 0) continue;
      crush.touch_side[contacts.first() + i] = 0;  // a ball pressed through touches from the other side, but not yet
      contacts.touches().depth[i] = std::min(contacts.touches().depth[i], 0.0);
    }
    ForceList forces(crush, ball);
    forces.begin_friction();
    AddingState state{crush.state, forces};
    const Before before = {crush};
    for (int i = 0; i < count; ++i) {
      ActiveContact contact;
      if (!is_active(crush.scene, crush.state, contacts.lists(), contacts.touches(), i, contact)) continue;
      force_of_pair(crush.scene, contacts.touches(), contact);
      rub_pair(crush.scene, state, contacts.lists().touching, contacts.touches(), before, contact);
    }
  }

 private:
  /// See FrictionTransfer.
  struct Before {
    const Crush& crush;

    [[nodiscard]] HWY_INLINE PairRange range_of(int ball) const {
      return {ball * kMostTouches, ball * kMostTouches + crush.before_count[ball]};
    }
    [[nodiscard]] HWY_INLINE int segment(int earlier) const { return crush.before_segment[earlier]; }
    [[nodiscard]] HWY_INLINE int pushed(int earlier) const { return crush.before_pushed[earlier]; }
    [[nodiscard]] HWY_INLINE double friction(int earlier) const { return crush.before_friction[earlier]; }
    [[nodiscard]] HWY_INLINE bool has_friction(int earlier) const { return crush.before_goes_on[earlier] != 0; }
  };
};

/// Adds up the forces of contacts and plates on a particle.
struct AddForces {
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.first_added.size(); }

  static HWY_INLINE void compute(Crush& crush, std::size_t particle, std::size_t /*step*/) {
    const int first = crush.first_added[particle];
    if (first == AddedForce::kEnd) return;
    ContactForce& force = crush.state.contact_force[particle];
    Points<One> elastic = Points<One>::load(&force.elastic);
    Points<One> viscous = Points<One>::load(&force.viscous);
    Points<One> friction = {0, 0};
    std::uint64_t done = 0;  // keys begin at 1
    for (int k = next_of(crush, first, done); k != AddedForce::kEnd; k = next_of(crush, first, done)) {
      const AddedForce& added = crush.added[k];
      const Points<One> low = {added.value[0], added.value[1]};
      if (added.part == AddedForce::kBoth) {
        elastic = elastic + low;
        viscous = viscous + Points<One>{added.value[2], added.value[3]};
      } else if (added.part == AddedForce::kElastic) {
        elastic = elastic + low;
      } else if (added.part == AddedForce::kViscous) {
        viscous = viscous + low;
      } else {
        friction = friction + low;
      }
      done = added.key;
    }
    elastic.store(&force.elastic);
    viscous.store(&force.viscous);
    if (!crush.state.friction_force.empty()) friction.store(&crush.state.friction_force[particle]);
    crush.first_added[particle] = AddedForce::kEnd;
  }

 private:
  /// That with the least key above one: lists are short.
  static HWY_INLINE int next_of(const Crush& crush, int first, std::uint64_t done) {
    int found = AddedForce::kEnd;
    for (int k = first; k != AddedForce::kEnd; k = crush.added[k].next) {
      const std::uint64_t key = crush.added[k].key;
      if (key > done && (found == AddedForce::kEnd || key < crush.added[found].key)) found = k;
    }
    return found;
  }
};

/// The forces of the plates.
struct AddPlates {
  static HWY_INLINE std::size_t items(const Crush& /*crush*/) { return 1; }

  static HWY_INLINE void compute(Crush& crush, std::size_t /*item*/, std::size_t /*step*/) {
    Totals& totals = crush.totals[0];
    totals.impact_force = {0.0, 0.0};
    totals.support_force = {0.0, 0.0};
    totals.contacts.stored = 0.0;  // of plates alone; see AddStored
    for (std::size_t word = 0; word < crush.pressed.size(); ++word) {
      for (unsigned bits = crush.pressed[word]; bits != 0; bits &= bits - 1) {
        const PlatePush& push = crush.plate_push[32 * word + std::countr_zero(bits)];
        totals.impact_force.elastic += push.impact.elastic;
        totals.impact_force.viscous += push.impact.viscous;
        totals.support_force.elastic += push.support.elastic;
        totals.support_force.viscous += push.support.viscous;
      }
    }
  }
};

/// What contacts store and how many there are, for a sample: before the next step.
struct AddStored {
  static HWY_INLINE std::size_t items(const Crush& /*crush*/) { return 1; }

  static HWY_INLINE void compute(Crush& crush, std::size_t /*item*/, std::size_t /*step*/) {
    ContactTotals& contacts = crush.totals[0].contacts;
    contacts.stored = 0.0;
    contacts.count = 0;
    double squared_depths = 0.0;
    for (std::size_t ball = 0; ball < crush.active_count.size(); ++ball) {
      if (crush.active_count[ball] == 0) continue;
      contacts.count += crush.active_count[ball];
      for (int i = 0; i < crush.touch_count[ball]; ++i) {
        squared_depths += crush.touch_squared_depth[ball * kMostTouches + i];
        contacts.stored += crush.touch_stored[ball * kMostTouches + i];
      }
    }
    contacts.stored += 0.5 * crush.scene.contact.stiffness * squared_depths;
    for (std::size_t word = 0; word < crush.pressed.size(); ++word) {
      for (unsigned bits = crush.pressed[word]; bits != 0; bits &= bits - 1) {
        const PlatePush& push = crush.plate_push[32 * word + std::countr_zero(bits)];
        contacts.stored += push.impact.stored;
        contacts.stored += push.support.stored;
      }
    }
  }
};

}  // namespace cellcrush::HWY_NAMESPACE
