#include "search/merge_band_contacts.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "search/candidate_lists.h"

namespace cellcrush {
namespace {

/// Leaves out released pairs. REQUIRES: no friction, as always with bands.
TouchMemory merge(const std::vector<ContactLists>& contacts) {
  std::vector<std::tuple<int, int, const TouchMemory*, std::size_t>> pairs;  // by ball and segment
  for (const ContactLists& lists : contacts) {
    const TouchMemory& from = lists.touching;
    for (std::size_t i = 0; i < from.count(); ++i) {
      if (from.side[i] != 0) {
        pairs.emplace_back(from.ball[i], from.segment[i], &from, i);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  TouchMemory merged;
  for (const auto& [ball, segment, from, i] : pairs) {
    merged.ball.push_back(ball);
    merged.segment.push_back(segment);
    merged.reach.push_back(from->reach[i]);
    merged.place.push_back(from->place[i]);
    merged.linked.push_back(from->linked[i]);
    merged.side.push_back(from->side[i]);
  }
  return merged;
}

}  // namespace

void merge_band_contacts(State& state) {
  if (state.contacts.size() > 1) {
    TouchMemory merged = merge(state.contacts);
    state.contacts.assign(state.contacts.size(), ContactLists());
    state.contacts.front().touching = std::move(merged);
    return;
  }
  ContactLists& lists = state.contacts.front();
  lists.face_list.clear();
  lists.face_clearance.clear();
  lists.face_next_check_travel.clear();
  lists.face_searched_position.clear();
  lists.face_searched_growth.clear();
  lists.group_travel.clear();
  lists.group_next_check_travel.clear();
  lists.batch_count = 0;
  clear_candidates(lists);
}

}  // namespace cellcrush
