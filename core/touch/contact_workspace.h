#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/lane_vector.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// A pair that touches and did not in the step before.
struct NewContact {
  int ball = 0;
  int segment = 0;
  int place = 0;  ///< into ContactLists::candidate_ball, of the ball's band or of the band before
  int next = 0;   ///< of the pairs that touched before, the first that it comes before
};

/// A ball that gained or lost a pair.
struct ChangedBall {
  int ball = 0;
  int place = 0;  ///< of the pair among those that touch, or of the pair that follows where it was
};

/// How the pairs of ContactLists::touching stand to each other in this step; T of them, in the same order.
struct Touches {
  LaneVector<int> start;            ///< T, particle at which the segment starts
  LaneVector<int> end;              ///< T, and ends
  LaneVector<int> known;            ///< T, place among the pairs that touched in the step before; kNew: did not
  LaneVector<double> share;         ///< T, of the foot along the segment: 0 at its start, 1 at its end
  LaneVector<double> depth;         ///< T, D, mm; not over 0: they are released
  LaneVector<Vector2> normal;       ///< T, from the segment to the ball
  LaneVector<double> viscous;       ///< T, c dD/dt, N, before it is held to what does not pull
  LaneVector<double> slip;          ///< T, mm by which the ball slid along the segment in the step
  LaneVector<int> node;             ///< T, the segment's particle nearer to the ball
  LaneVector<double> node_depth;    ///< T, of the balls of both, mm; over 0: they touch. 0 where they coincide
  LaneVector<Vector2> node_normal;  ///< T, from that particle to the ball

  static constexpr int kNew = -1;

  void resize(std::size_t count);
};

/// A touch that exerts forces.
struct ActiveContact {
  int touch = 0;  ///< into ContactLists::touching

  // Two balls that touch are found by each of them, and a ball over a node of a straight chain by the node's ball, too.
  // The double count is subtracted, half of it with either touch.
  int node_touch = kNone;  ///< the touch whose node of the polyline is nearest to the ball, whose ball it touches

  /// Of the pair's viscous force and friction, this touch has all or none.
  bool has_pair = true;
  double net_depth = 0.0;     ///< mm: k times it bounds the viscous force
  double normal_force = 0.0;  ///< N, that friction goes by

  static constexpr int kNone = -1;
};

/// What a thread works with; what it makes is put behind what those before it made.
struct ContactPart {
  std::vector<int> awake;     ///< places of the candidates that are tested, ascending; it does not shrink
  std::vector<int> found;     ///< of those, they that have begun to overlap
  std::vector<int> released;  ///< of ContactLists::touching
  std::vector<ActiveContact> active;
};

/// Room for evaluate_contact_forces, kept from step to step so that none allocates. No result depends on what it holds.
struct ContactWorkspace {
  std::vector<ContactPart> parts;  ///< one a thread
  std::vector<int> found;          ///< of all parts
  std::vector<NewContact> new_contacts;
  std::vector<ChangedBall> changes;
  TouchMemory before;  ///< ContactLists::touching of the step before
  Touches touches;
  std::vector<ActiveContact> active;  ///< of all parts
};

}  // namespace cellcrush
