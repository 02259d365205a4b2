#include "contact/contact_search.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "contact/search/bucket_search.h"
#include "contact/search/candidate_lists.h"
#include "contact/search/face_search.h"
#include "contact/touch/contact_stages.h"

namespace cellcrush {
namespace {

void search_space(const Scene& scene, State& state) {
  const bool is_planar = search_buckets(scene, state, state.contacts.front());
  if (!is_planar && state.crossing_step < 0) {
    state.crossing_step = state.step;
  }
}

/// The touching pairs of all bands, by ball and segment, without released ones. REQUIRES: no friction, as always with
/// bands.
TouchMemory merge_touching(const std::vector<ContactLists>& contacts) {
  std::vector<std::tuple<int, int, const TouchMemory*, std::size_t>> pairs;
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

/// Ends the search by faces: keeps the touching pairs, in the first list, and removes all candidates.
void drop_faces(State& state) {
  if (state.contacts.size() > 1) {
    TouchMemory merged = merge_touching(state.contacts);
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

/// Adapts the touching pairs to walls that have changed, and releases those of a ball that now ends its segment.
void renew_touching(const Scene& scene, ContactLists& lists) {
  TouchMemory& touching = lists.touching;
  lists.released.clear();
  for (std::size_t i = 0; i < touching.count(); ++i) {
    const Element& segment = scene.elements[touching.segment[i]];
    const int ball = touching.ball[i];
    touching.reach[i] = scene.reach_of(ball, touching.segment[i]);
    touching.side[i] = ball == segment.start || ball == segment.end ? 0 : touching.side[i];
    if (touching.side[i] == 0) {
      lists.released.push_back(static_cast<int>(i));
    }
    link_pairs_of_ball(scene, touching, ball, static_cast<int>(i));
  }
}

}  // namespace

bool searches_faces(const Scene& scene, const State& state) {
  return scene.faces.are_enough() && state.contacts.front().searched_position.empty() && state.crossing_step < 0;
}

bool has_left_faces(const Scene& scene, const State& state) {
  return scene.contact.present && scene.faces.are_enough() && !searches_faces(scene, state);
}

bool find_band_contacts(const Scene& scene, State& state, std::size_t band, Workers& workers) {
  return search_faces(scene, state, band, state.contacts[band], workers);
}

void find_contacts(const Scene& scene, State& state, Workers& workers) {
  if (!scene.contact.present) {
    return;
  }
  bool is_planar = true;
  for (std::size_t band = 0; band < scene.bands.size() && is_planar && searches_faces(scene, state); ++band) {
    is_planar = find_band_contacts(scene, state, band, workers);
  }
  if (!is_planar) {
    change_topology(scene, state, TopologyChange::walls_crossed, state.step);
  }
  if (!searches_faces(scene, state)) {
    search_space(scene, state);
  }
}

void change_topology(const Scene& scene, State& state, TopologyChange change, std::int64_t step) {
  drop_faces(state);
  ContactLists& lists = state.contacts.front();
  switch (change) {
    case TopologyChange::walls_crossed:
      // The next step lists pairs by buckets.
      state.crossing_step = step;
      break;
    case TopologyChange::borders_near: search_space(scene, state); break;
    case TopologyChange::walls_changed:
      lists.searched_position.clear();
      renew_touching(scene, lists);
      if (state.contacts.size() > 1 || !searches_faces(scene, state)) {
        search_space(scene, state);
      }
      break;
  }
}

}  // namespace cellcrush
