#include "contact/search/candidate_lists.h"

#include <limits>
#include <utility>

namespace cellcrush {
namespace {

/// Travel of the next check of a candidate that is not tested.
constexpr double kNever = std::numeric_limits<double>::infinity();

int batches_for(int count) { return (count + kCandidateBatch - 1) / kCandidateBatch; }

void put(ContactLists& lists, int index, const Candidate& candidate) {
  lists.candidate_ball[index] = candidate.ball;
  lists.candidate_segment[index] = candidate.segment;
  lists.candidate_reach[index] = candidate.reach;
  lists.candidate_next_check_travel[index] = candidate.reach > 0.0 ? 0.0 : kNever;
}

void resize(ContactLists& lists, std::size_t size) {
  resize_with_room(lists.candidate_ball, size);
  resize_with_room(lists.candidate_segment, size);
  resize_with_room(lists.candidate_reach, size);
  resize_with_room(lists.candidate_next_check_travel, size, kNever);
}

/// Moves a list to new entries at the end. Its contents are lost.
void move_to_end(ContactLists& lists, FaceList& list, int count) {
  for (int i = 0; i < list.count; ++i) {
    put(lists, list.first + i, Candidate());
  }
  list.first = static_cast<int>(lists.candidate_ball.size());
  list.room = batches_for(count) * kCandidateBatch;
  list.count = 0;
  resize(lists, lists.candidate_ball.size() + list.room);
  resize_with_room(lists.batch_group, lists.candidate_ball.size() / kCandidateBatch, list.group);
}

void close_up(ContactLists& lists) {
  const std::vector<int> ball = std::move(lists.candidate_ball);
  const std::vector<int> segment = std::move(lists.candidate_segment);
  const std::vector<double> reach = std::move(lists.candidate_reach);
  clear_candidates(lists);
  for (FaceList& list : lists.face_list) {
    const FaceList before = list;
    list.count = 0;
    move_to_end(lists, list, before.count);
    list.count = before.count;
    for (int i = 0; i < list.count; ++i) {
      const int from = before.first + i;
      put(lists, list.first + i, {ball[from], segment[from], reach[from]});
    }
  }
}

}  // namespace

void replace_list(ContactLists& lists, int face, const std::vector<Candidate>& candidates) {
  FaceList& list = lists.face_list[face];
  const int count = static_cast<int>(candidates.size());
  lists.candidate_count += count - list.count;
  lists.batch_count += batches_for(count) - batches_for(list.count);
  if (count > list.room) {
    move_to_end(lists, list, count);
  }
  for (int i = 0; i < list.count || i < count; ++i) {
    put(lists, list.first + i, i < count ? candidates[i] : Candidate());
  }
  list.count = count;
  if (static_cast<std::int64_t>(lists.batch_group.size()) > lists.batch_count + lists.batch_count / 4 + kEmptyBatches) {
    close_up(lists);
  }
}

void wake_candidate(ContactLists& lists, int index, int ball, int segment) {
  const auto k = static_cast<std::size_t>(index);
  // If the list has been rebuilt, the candidate is tested in any case unless it was found to overlap.
  if (k < lists.candidate_ball.size() && lists.candidate_ball[k] == ball && lists.candidate_segment[k] == segment) {
    lists.candidate_next_check_travel[k] = 0.0;
  }
}

void add_candidate(ContactLists& lists, const Candidate& candidate) {
  resize(lists, lists.candidate_ball.size() + 1);
  put(lists, static_cast<int>(lists.candidate_ball.size()) - 1, candidate);
  ++lists.candidate_count;
}

void fill_batch(ContactLists& lists) {
  resize(lists, static_cast<std::size_t>(batches_for(static_cast<int>(lists.candidate_ball.size()))) * kCandidateBatch);
}

void clear_candidates(ContactLists& lists) {
  resize(lists, 0);
  lists.batch_group.clear();
}

}  // namespace cellcrush
