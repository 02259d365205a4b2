#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cellcrush/lane_vector.h"
#include "cellcrush/tuning.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// What is remembered of the T pairs of a ball and a segment that touch; by ball, segments ascending.
struct TouchMemory {
  std::vector<int> ball;      ///< T, particle
  std::vector<int> segment;   ///< T, element
  std::vector<double> reach;  ///< T, mm, distance at which they touch
  std::vector<int>
      place;  ///< T, of the candidate by which the pair was found, in this list or that of the band before;
              ///< the face's list may be another since then
  std::vector<int> linked;  ///< T, 1: shares a particle with the segment of another of the ball's pairs; 0: with none
  std::vector<int> side;    ///< T, +1 left, -1 right of the segment: where the ball is, or came from; 0: released
  std::vector<int> pushed;  ///< T, the side from which it pushed on the ball with friction in the newest step; 0: it
                            ///< did not. Empty without friction
  std::vector<double>
      friction;  ///< T, N, on the ball, along the segment, round its ends with it; kept while it pushes.
                 ///< Empty without friction

  [[nodiscard]] std::size_t count() const { return ball.size(); }
};

/// Where the candidates of a face stand: `count` of them from `first` on, then empty places up to `room`; whole
/// batches.
struct FaceList {
  int first = 0;
  int count = 0;
  int room = 0;
  int group = 0;  ///< of faces, to which it belongs
};

/// Which pairs may touch, of a band's faces (Scene::bands), and which do, of its balls; or of all.
struct ContactLists {
  // Written by find_contacts. K places for candidates, in whole batches: balls and segments that may touch before they
  // are looked for again.
  std::vector<int> candidate_ball;      ///< K, particle
  std::vector<int> candidate_segment;   ///< K, element
  std::vector<double> candidate_reach;  ///< K, mm, distance at which they touch; 0: an empty place
  std::int64_t candidate_count = 0;     ///< of the places that are not empty

  // The same, of a search by buckets; empty where contacts are searched by faces.
  LaneVector<Vector2> searched_position;  ///< N, where the particles were when the list was made
  std::int64_t search_count = 0;

  // The same, of a search by faces (search/face_search.h): F faces, C corners, G groups. Empty when by buckets.
  std::vector<FaceList> face_list;     ///< F
  std::vector<double> face_clearance;  ///< F, mm by which gaps may close before a pair that is not listed touches
  std::vector<double> face_next_check_travel;   ///< F, travel of its group at which the face is checked next
  std::vector<Vector2> face_searched_position;  ///< C, where the corners were when the face's list was made
  std::vector<double> group_travel;             ///< G, mm by which gaps of the group can have closed since the start
  std::vector<double> group_next_check_travel;  ///< G, the least of its faces
  std::vector<int> batch_group;                 ///< K / kCandidateBatch, group of the batch's face
  std::int64_t batch_count = 0;                 ///< batches that the faces' candidates need
  std::int64_t face_recheck_count = 0;          ///< faces rechecked since the start
  std::int64_t face_search_count = 0;           ///< face lists rebuilt since the start

  // Written by evaluate_contact_forces.
  TouchMemory touching;       ///< of the pairs that touch now, and those released in this step
  std::vector<int> released;  ///< of `touching`, ascending: those released
  /// K, travel of the group at which a candidate is tested next; infinite while it is in `touching`, and of empty
  /// places.
  LaneVector<double> candidate_next_check_travel;
};

/// Of all contacts between walls, and of the plates so far as it says so.
struct ContactTotals {
  double stored = 0.0;               ///< sum of k D^2 / 2 now, walls' and plates', N mm
  std::int64_t count = 0;            ///< closed contacts now
  double deepest_penetration = 0.0;  ///< since the start, over the thinner wall's thickness
  double deepest_birth = 0.0;        ///< the same, of contacts in the step in which they first touched
};

/// See visit_fields.
template <class L, class Visitor>
void visit_search_fields(L& lists, Visitor&& visitor) {
  visitor("candidate_ball", lists.candidate_ball);
  visitor("candidate_segment", lists.candidate_segment);
  visitor("candidate_reach", lists.candidate_reach);
  visitor("candidate_count", lists.candidate_count);
  visitor("searched_position", lists.searched_position);
  visitor("search_count", lists.search_count);
  visitor("face_list", lists.face_list);
  visitor("face_budget", lists.face_clearance);
  visitor("face_alarm", lists.face_next_check_travel);
  visitor("face_searched_position", lists.face_searched_position);
  visitor("group_travel", lists.group_travel);
  visitor("group_alarm", lists.group_next_check_travel);
  visitor("batch_group", lists.batch_group);
  visitor("batch_count", lists.batch_count);
  visitor("face_look_count", lists.face_recheck_count);
  visitor("face_search_count", lists.face_search_count);
}

template <class L, class Visitor>
void visit_touch_fields(L& lists, Visitor&& visitor) {
  visitor("touching_ball", lists.touching.ball);
  visitor("touching_segment", lists.touching.segment);
  visitor("touching_reach", lists.touching.reach);
  visitor("touching_place", lists.touching.place);
  visitor("touching_linked", lists.touching.linked);
  visitor("touching_side", lists.touching.side);
  visitor("touching_pushed", lists.touching.pushed);
  visitor("touching_friction", lists.touching.friction);
  visitor("parted", lists.released);
  visitor("candidate_alarm", lists.candidate_next_check_travel);
}

}  // namespace cellcrush
