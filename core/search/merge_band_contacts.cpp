#include "search/merge_band_contacts.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "search/candidate_lists.h"

namespace cellcrush {
namespace {

/// A pair in one of the lists.
struct Pair {
  const TouchMemory* touching;
  std::size_t place;

  bool operator<(const Pair& other) const {
    return std::tie(touching->ball[place], touching->segment[place]) <
           std::tie(other.touching->ball[other.place], other.touching->segment[other.place]);
  }
};

/// Leaves out released pairs. REQUIRES: no friction, as always with bands.
TouchMemory merge(const std::vector<ContactLists>& contacts) {
  std::vector<Pair> pairs;
  for (const ContactLists& lists : contacts) {
    for (std::size_t i = 0; i < lists.touching.count(); ++i) {
      if (lists.touching.side[i] != 0) {
        pairs.push_back({&lists.touching, i});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  TouchMemory merged;
  for (const auto& [from, i] : pairs) {
    merged.ball.push_back(from->ball[i]);
    merged.segment.push_back(from->segment[i]);
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
  lists.group_travel.clear();
  lists.group_next_check_travel.clear();
  lists.batch_count = 0;
  clear_candidates(lists);
}

}  // namespace cellcrush
