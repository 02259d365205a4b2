#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/state.h"
#include "cellcrush/vector.h"
#include "contact/search/candidate_lists.h"

namespace cellcrush {

/// A pair that touches now but did not in the step before.
struct NewContact {
  int ball = 0;
  int segment = 0;
  int index = 0;  ///< index into ContactLists::candidate_ball, of the band of the ball or of the band before
  int next = 0;   ///< index of the first of the earlier pairs that follows it
};

/// A ball that gained or lost a pair.
struct ChangedBall {
  int ball = 0;
  int index = 0;  ///< index of the pair in ContactLists::touching, or of the pair that follows its former position
};

/// Touching pairs from `first` to `end`.
struct PairRange {
  int first = 0;
  int end = 0;
};

/// The pairs of a ball. `index` is that of one of them, or of the one after the last; otherwise the range is empty.
inline PairRange pairs_of_ball(const TouchMemory& touching, int ball, int index) {
  PairRange range = {index, index};
  while (range.first > 0 && touching.ball[range.first - 1] == ball) {
    --range.first;
  }
  while (range.end < static_cast<int>(touching.count()) && touching.ball[range.end] == ball) {
    ++range.end;
  }
  return range;
}

/// Geometry and motion of the pairs of ContactLists::touching in this step; T of them, in the same order.
struct Touches {
  LaneVector<int> start;          ///< T, particle at which the segment starts
  LaneVector<int> end;            ///< T, particle at which the segment ends
  LaneVector<int> known;          ///< T, index among the pairs that touched in the step before; kNew: it did not
  LaneVector<double> growth;      ///< T, mm, what the reach has grown by at the foot (E8d)
  LaneVector<double> offset;      ///< T, mm, of the ball to the left of the segment
  LaneVector<double> share;       ///< T, s of the foot along the segment: 0 at its start, 1 at its end
  LaneVector<double> depth;       ///< T, D, mm (E8); if not above 0, the pair is released
  LaneVector<double> deflection;  ///< T, mm, of the segment at the foot towards the ball (E8e); set where they bend
  LaneVector<Vector2> normal;     ///< T, unit normal from the segment to the ball
  LaneVector<double> viscous;     ///< T, c dD/dt, N, before it is limited so that the contact does not pull
  LaneVector<double> slip;        ///< T, mm, slip of the ball along the segment in the step, by their mid-lines
  LaneVector<int> node;           ///< T, node of the segment nearer to the ball
  /// T, mm, D_n, overlap of the ball with the ball at that node (E8b); above 0: they touch; 0 if they coincide.
  LaneVector<double> node_depth;
  LaneVector<Vector2> node_normal;  ///< T, unit normal from that node to the ball

  static constexpr int kNew = -1;

  void resize(std::size_t count) {
    const auto resize_all = [count](auto&... arrays) { (resize_with_room(arrays, count), ...); };
    resize_all(start, end, known, growth, offset, share, depth, deflection, normal, viscous, slip, node, node_depth,
               node_normal);
  }
};

/// A touch that exerts forces.
struct ActiveContact {
  int touch = 0;       ///< index into ContactLists::touching
  double share = 1.0;  ///< in the contact of the ball with its polyline (E8b)

  // Two balls that touch are found by each of them. A ball over a node of a straight chain is also found by the ball of
  // that node. The double count is subtracted, half of it with either touch (E8b).
  int node_touch = kNone;  ///< the touch at the node of the polyline nearest to the ball, if the balls of both touch

  /// Whether this touch has the viscous force and the friction of the pair: it has all of them or none.
  bool has_pair = true;
  double net_depth = 0.0;     ///< mm; k times this bounds the viscous force
  double normal_force = 0.0;  ///< N, f of E9b, which limits friction

  static constexpr int kNone = -1;
};

/// Working arrays of a thread; the results of all threads are appended in the order of the threads.
struct ContactPart {
  std::vector<int> awake;     ///< indices of the candidates that are tested, ascending; it does not shrink
  std::vector<int> found;     ///< those of them that have begun to overlap
  std::vector<int> released;  ///< indices into ContactLists::touching
  std::vector<ActiveContact> active;
};

/// Scratch for evaluate_contact_forces, kept from step to step so that no step allocates. No result depends on its
/// contents.
struct ContactWorkspace {
  std::vector<ContactPart> parts;  ///< one per thread
  std::vector<int> found;          ///< of all parts
  std::vector<NewContact> new_contacts;
  std::vector<ChangedBall> changes;
  TouchMemory before;  ///< ContactLists::touching of the step before
  Touches touches;
  std::vector<ActiveContact> active;  ///< of all parts
};

/// Sums over the contacts of a step. Their forces are summed in the order of balls, band by band.
struct ContactSums {
  ContactTotals walls;
  PlateForce impact;
  PlateForce support;
  std::vector<RigidWallForce> rigid_walls;
  SideForce sides;
  /// Pairs with balls of the next band, found in a face that this band searches.
  std::vector<NewContact> of_next_band;
};

/// The sums at the start of a step.
inline ContactSums begin_contact_sums(const State& state) {
  ContactSums sums;
  sums.walls.deepest_penetration = state.contact_totals.deepest_penetration;
  sums.walls.deepest_birth = state.contact_totals.deepest_birth;
  sums.rigid_walls.resize(state.rigid_wall_force.size());
  return sums;
}

/// Stores the sums of the newest step in the state.
inline void put_contact_sums(const ContactSums& sums, State& state) {
  state.contact_totals = sums.walls;
  state.impact_force = sums.impact;
  state.support_force = sums.support;
  state.rigid_wall_force = sums.rigid_walls;
  if (!state.side_force.empty()) {
    state.side_force.front() = sums.sides;
  }
}

}  // namespace cellcrush
