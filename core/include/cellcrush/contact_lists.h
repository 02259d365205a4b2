#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cellcrush/tuning.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// History of the T touching pairs of a ball and a segment; sorted by ball, then by segment.
struct TouchMemory {
  std::vector<int> ball;     ///< T, particle
  std::vector<int> segment;  ///< T, element
  std::vector<double>
      reach;  ///< T, mm, distance at which the pair touches (E8, E8a), with the thickness before loading
  /// T, index of the candidate by which the pair was found, in this list or in that of the band before. The list of the
  /// face may have been rebuilt since.
  std::vector<int> place;
  /// T, 1: another of the ball's pairs has a segment that shares a particle with this one; 0: none has.
  std::vector<int> linked;
  /// T, side of the segment on which the ball is or from which it came: +1 left, -1 right; 0: released.
  std::vector<int> side;
  /// T, rad, bend of the segment when the pair began to touch (E8e). Empty unless segments bend.
  std::vector<double> bend;
  /// T, side from which the segment pushed the ball, with friction, in the newest step; 0: it did not. Empty without
  /// friction.
  std::vector<int> pushed;
  /// T, N, friction force on the ball, along the segment and, at its ends, round them. Kept while the pair pushes.
  /// Empty without friction.
  std::vector<double> friction;

  [[nodiscard]] std::size_t count() const { return ball.size(); }
};

/// Where the candidates of a face are stored: `count` of them from `first` on, then empty entries up to `room`, in
/// whole batches.
struct FaceList {
  int first = 0;
  int count = 0;
  int room = 0;
  int group = 0;  ///< group to which the face belongs
};

/// Candidate pairs of the faces of a band (Scene::bands) and touching pairs of its balls; or those of the whole
/// lattice.
struct ContactLists {
  // Written by find_contacts. K entries for candidates, in whole batches: balls and segments that may touch before the
  // next search.
  std::vector<int> candidate_ball;     ///< K, particle
  std::vector<int> candidate_segment;  ///< K, element
  /// K, mm, distance at which the pair touches (E8, E8a), with the thickness before loading; 0: an empty entry.
  std::vector<double> candidate_reach;
  std::int64_t candidate_count = 0;  ///< number of entries that are not empty
  double reach_growth = 0.0;         ///< mm by which reaches can have grown since the start (E5f)

  // Search by buckets only; empty where contacts are searched by faces.
  LaneVector<Vector2> searched_position;  ///< N, positions of the particles when the list was made
  double searched_growth = 0.0;           ///< reach_growth when the list was made
  std::int64_t search_count = 0;

  // Search by faces only (E8c, contact/search/pair_search.h); empty where contacts are searched by buckets. F faces, S
  // corners and thick ends, G groups.
  std::vector<FaceList> face_list;              ///< F
  std::vector<double> face_clearance;           ///< F, mm by which gaps may close before an unlisted pair touches
  std::vector<double> face_next_check_travel;   ///< F, travel of its group at which the face is next checked
  std::vector<Vector2> face_searched_position;  ///< S, positions of the face's particles when its list was made
  std::vector<double> face_searched_growth;     ///< F, reach_growth when the face's list was made
  std::vector<double> group_travel;             ///< G, mm by which gaps of the group can have closed since the start
  std::vector<double> group_next_check_travel;  ///< G, minimum over its faces
  std::vector<int> batch_group;                 ///< K / kCandidateBatch, group of the batch's face
  std::int64_t batch_count = 0;                 ///< batches that the faces' candidates need
  std::int64_t face_recheck_count = 0;          ///< faces rechecked since the start
  std::int64_t face_search_count = 0;           ///< face lists rebuilt since the start

  // Written by evaluate_contact_forces.
  TouchMemory touching;       ///< pairs that touch now, and those released in this step
  std::vector<int> released;  ///< indices into `touching` of the pairs released in this step, ascending
  /// K, travel of the group at which a candidate is next tested; infinite while its pair is in `touching`, and for an
  /// empty entry.
  LaneVector<double> candidate_next_check_travel;
};

/// Totals over all contacts between walls; those at the plates are included only where stated.
struct ContactTotals {
  double stored = 0.0;               ///< elastic energy stored in contacts now (E8b), plates included, N mm
  std::int64_t count = 0;            ///< contacts closed now
  double deepest_penetration = 0.0;  ///< greatest since the start, divided by the thickness of the thinner wall
  double deepest_birth = 0.0;        ///< the same, in the step in which a contact first touched
};

// See visit_fields in state.h, which calls these two one after the other.

template <class L, class Visitor>
void visit_search_fields(L& lists, Visitor&& visit) {
  auto& [candidate_ball, candidate_segment, candidate_reach, candidate_count, reach_growth, searched_position,
         searched_growth, search_count, face_list, face_clearance, face_next_check_travel, face_searched_position,
         face_searched_growth, group_travel, group_next_check_travel, batch_group, batch_count, face_recheck_count,
         face_search_count, touching, released, candidate_next_check_travel] = lists;
  const auto list = [&visit](auto&... fields) { (visit(fields), ...); };
  list(candidate_ball, candidate_segment, candidate_reach, candidate_count, reach_growth, searched_position,
       searched_growth, search_count, face_list, face_clearance, face_next_check_travel, face_searched_position,
       face_searched_growth, group_travel, group_next_check_travel, batch_group, batch_count, face_recheck_count,
       face_search_count);
}

template <class L, class Visitor>
void visit_touch_fields(L& lists, Visitor&& visit) {
  auto& [ball, segment, reach, place, linked, side, bend, pushed, friction] = lists.touching;
  const auto list = [&visit](auto&... fields) { (visit(fields), ...); };
  list(ball, segment, reach, place, linked, side, bend, pushed, friction);
  list(lists.released, lists.candidate_next_check_travel);
}

}  // namespace cellcrush
