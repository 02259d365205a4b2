#include "contact/face_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/candidate_lists.h"
#include "contact/face_pairs.h"

namespace cellcrush {
namespace {

/// Share of a face's budget below which it is not worth to look again.
constexpr double kWorthAnotherLook = 0.1;

void begin(const Scene& scene, State& state) {
  const ContactFaces& faces = scene.faces;
  state.face_list.resize(faces.count());
  state.face_budget.assign(faces.count(), 0.0);
  state.face_alarm.assign(faces.count(), 0.0);
  state.face_searched_position.assign(faces.particle.size(), Vector2::Zero());
  state.group_travel.assign(faces.group_count(), 0.0);
  state.group_alarm.assign(faces.group_count(), 0.0);
}

void give_up(State& state) {
  state.crossing_step = state.step;
  state.face_list.clear();
  state.face_budget.clear();
  state.face_alarm.clear();
  state.face_searched_position.clear();
  state.group_travel.clear();
  state.group_alarm.clear();
}

/// Diagonal of the box round the velocities of a group, mm/s.
double spread_of_velocities(const ContactFaces& faces, const State& state, int group) {
  constexpr int kLanes = 4;  // not to wait for one minimum after the other
  const int* member = &faces.member[faces.member_offset[group]];
  const int count = faces.member_offset[group + 1] - faces.member_offset[group];
  Vector2 low[kLanes];
  Vector2 high[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    low[lane] = high[lane] = state.velocity[member[0]];
  }
  const auto take = [&](int lane, int i) {
    low[lane] = low[lane].cwiseMin(state.velocity[member[i]]);
    high[lane] = high[lane].cwiseMax(state.velocity[member[i]]);
  };
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      take(lane, i + lane);
    }
  }
  for (; i < count; ++i) {
    take(0, i);
  }
  for (int lane = 1; lane < kLanes; ++lane) {
    low[0] = low[0].cwiseMin(low[lane]);
    high[0] = high[0].cwiseMax(high[lane]);
  }
  return (high[0] - low[0]).norm();
}

/// Diagonal of the box round the displacements of a face's particles since its list was made, mm.
double spread_of_displacements(const ContactFaces& faces, const State& state, int face) {
  const int first = faces.offset[face];
  Vector2 low = state.position[faces.particle[first]] - state.face_searched_position[first];
  Vector2 high = low;
  for (int k = first + 1; k < faces.offset[face + 1]; ++k) {
    const Vector2 displacement = state.position[faces.particle[k]] - state.face_searched_position[k];
    low = low.cwiseMin(displacement);
    high = high.cwiseMax(displacement);
  }
  return (high - low).norm();
}

void make_list(const Scene& scene, State& state, int face) {
  const FacePairs pairs = find_face_pairs(scene, state, face, scene.contact.face_skin);
  if (pairs.crossed) {
    give_up(state);
    return;
  }
  replace_list(state, face, pairs.candidates);
  // Of a face with candidates no more than the skin: an end that has gone through a segment is found while it is near.
  state.face_budget[face] = pairs.candidates.empty() ? pairs.least_gap : scene.contact.face_skin;
  for (int k = scene.faces.offset[face]; k < scene.faces.offset[face + 1]; ++k) {
    state.face_searched_position[k] = state.position[scene.faces.particle[k]];
  }
  ++state.face_search_count;
}

/// Sets the alarm of a face anew, with a list made anew if need be.
void look_at(const Scene& scene, State& state, int group, int face) {
  ++state.face_look_count;
  double left = 0.0;
  if (state.face_budget[face] > 0.0) {
    left = state.face_budget[face] - spread_of_displacements(scene.faces, state, face);
  }
  if (!(left > kWorthAnotherLook * state.face_budget[face])) {
    make_list(scene, state, face);
    if (state.crossing_step >= 0) {
      return;
    }
    left = state.face_budget[face];
  }
  state.face_alarm[face] = state.group_travel[group] + left;
}

void look_at_group(const Scene& scene, State& state, int group) {
  double least = std::numeric_limits<double>::max();
  for (int face = scene.faces.group_offset[group]; face < scene.faces.group_offset[group + 1]; ++face) {
    if (state.face_alarm[face] <= state.group_travel[group]) {
      look_at(scene, state, group, face);
      if (state.crossing_step >= 0) {
        return;
      }
    }
    least = std::min(least, state.face_alarm[face]);
  }
  state.group_alarm[group] = least;
}

}  // namespace

void search_faces(const Scene& scene, State& state) {
  if (state.face_list.empty()) {
    begin(scene, state);
  }
  for (int group = 0; group < scene.faces.group_count() && state.crossing_step < 0; ++group) {
    state.group_travel[group] += scene.schedule.time_step * spread_of_velocities(scene.faces, state, group);
    if (state.group_alarm[group] <= state.group_travel[group]) {
      look_at_group(scene, state, group);
    }
  }
}

}  // namespace cellcrush
