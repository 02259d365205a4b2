#include "contact/contact_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "contact/search/candidate_lists.h"
#include "contact/search/pair_search.h"
#include "contact/start_overlaps.h"
#include "contact/touch/contact_stages.h"
#include "geometry/bucket_grid.h"

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
void renew_touching(const Scene& scene, const State& state, ContactLists& lists) {
  TouchMemory& touching = lists.touching;
  lists.released.clear();
  for (std::size_t i = 0; i < touching.count(); ++i) {
    const Element& segment = scene.elements[touching.segment[i]];
    const int ball = touching.ball[i];
    touching.reach[i] = reach_now(scene, state, ball, touching.segment[i]);
    touching.side[i] = ball == segment.start || ball == segment.end ? 0 : touching.side[i];
    if (touching.side[i] == 0) {
      lists.released.push_back(static_cast<int>(i));
    }
    link_pairs_of_ball(scene, touching, ball, static_cast<int>(i));
  }
}

/// Whether a contact between two particles of the border involves two adjacent bands only.
bool are_neighbours(const BorderParticle& a, const BorderParticle& b) {
  return std::max(a.last_band, b.last_band) - std::min(a.band, b.band) <= 1;
}

/// At least the speed at which any two particles of the border approach each other, mm/s.
double highest_approach(const std::vector<BorderParticle>& border, const State& state) {
  Eigen::AlignedBox2d velocities;
  for (const BorderParticle& at : border) {
    if (state.velocity[at.particle].allFinite()) velocities.extend(state.velocity[at.particle]);
  }
  return velocities.isEmpty() ? 0.0 : velocities.diagonal().norm();
}

/// Length of the longest element that ends at the border, mm.
double longest_at_border(const Scene& scene, const State& state) {
  double longest = 0.0;
  for (const BorderParticle& at : scene.faces.border) {
    for (int k = scene.incidence_offset[at.particle]; k < scene.incidence_offset[at.particle + 1]; ++k) {
      const Element& element = scene.elements[scene.incidence[k]];
      const double length = (state.position[element.end] - state.position[element.start]).norm();
      longest = std::isfinite(length) ? std::max(longest, length) : longest;
    }
  }
  return longest;
}

/// Whether bands follow each other along a direction, with more than a margin between bands that are not adjacent. This
/// holds nearly always.
bool follow_each_other(const Scene& scene, const State& state, const Vector2& direction, double margin) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const std::size_t bands = scene.bands.size();
  std::vector<double> highest(bands, -kFar);  // of the particles of bands up to this one
  std::vector<double> lowest(bands, kFar);    // of the particles of bands from this one on
  for (const BorderParticle& at : scene.faces.border) {
    const double place = direction.dot(state.position[at.particle]);
    highest[at.band] = std::max(highest[at.band], place);
    lowest[at.last_band] = std::min(lowest[at.last_band], place);
  }
  for (std::size_t b = 1; b < bands; ++b) {
    highest[b] = std::max(highest[b], highest[b - 1]);
    lowest[bands - 1 - b] = std::min(lowest[bands - 1 - b], lowest[bands - b]);
  }
  for (std::size_t b = 2; b < bands; ++b) {
    if (!(highest[b - 2] + margin < lowest[b])) {
      return false;
    }
  }
  return true;
}

/// The least distance of two particles of bands that are not adjacent, or a margin if none are nearer.
double least_distance(const Scene& scene, const State& state, double margin) {
  std::vector<BorderParticle> border;
  std::vector<Vector2> place;
  for (const BorderParticle& at : scene.faces.border) {
    if (state.position[at.particle].allFinite()) {
      border.push_back(at);
      place.push_back(state.position[at.particle]);
    }
  }
  if (place.empty()) {
    return margin;
  }
  const BucketGrid grid(place, margin);
  const Vector2 reach = Vector2::Constant(margin);
  double least = margin;
  for (std::size_t i = 0; i < place.size(); ++i) {
    grid.visit_box(place[i] - reach, place[i] + reach, [&](int other) {
      if (!are_neighbours(border[i], border[other])) least = std::min(least, (place[i] - place[other]).norm());
    });
  }
  return least;
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
  note_parted_walls(scene, state);
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
      renew_touching(scene, state, lists);
      if (state.contacts.size() > 1 || !searches_faces(scene, state)) {
        search_space(scene, state);
      }
      break;
  }
}

std::int64_t steps_with_borders_apart(const Scene& scene, const State& state, std::int64_t most) {
  // A ball that touches an element is no farther from one of its ends than from its mid-line, plus half of its length.
  const double touch = 0.5 * longest_at_border(scene, state) + 2.0 * scene.greatest_radius();
  const double in_a_step = 2.0 * highest_approach(scene.faces.border, state) * scene.schedule.time_step;
  const double margin = touch + in_a_step * static_cast<double>(most);
  const Vector2 directions[] = {Vector2::UnitX(), Vector2::UnitY(), -Vector2::UnitX(), -Vector2::UnitY()};
  if (std::any_of(std::begin(directions), std::end(directions),
                  [&](const Vector2& direction) { return follow_each_other(scene, state, direction, margin); })) {
    return most;
  }
  const double least = least_distance(scene, state, margin);
  if (least >= margin) return most;
  return least > touch ? static_cast<std::int64_t>((least - touch) / in_a_step) : 0;
}

}  // namespace cellcrush
