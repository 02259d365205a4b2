#include "contact/face_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "contact/candidate_lists.h"
#include "contact/face_pairs.h"
#include "contact/wide_velocities.h"
#include "simd/target.h"

namespace cellcrush {
namespace {

/// Share of a face's budget below which it is not worth to look again.
constexpr double kWorthAnotherLook = 0.1;
/// Skin of a face of many corners, in skins of the others.
constexpr double kWideSkin = 3.5;

void begin(const Scene& scene, State& state) {
  const ContactFaces& faces = scene.faces;
  state.face_list.resize(faces.count());
  for (int group = 0; group < faces.group_count(); ++group) {
    for (int face = faces.group_offset[group]; face < faces.group_offset[group + 1]; ++face) {
      state.face_list[face].group = group;
    }
  }
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
  state.batch_count = 0;
  clear_candidates(state);
}

VelocityBox box_of_velocities_plain(const State& state, std::span<const int> members) {
  VelocityBox box = {state.velocity[members.front()], state.velocity[members.front()]};
  for (const int particle : members) {
    // A velocity first: a minimum overwrites its first operand.
    box.low = state.velocity[particle].cwiseMin(box.low);
    box.high = state.velocity[particle].cwiseMax(box.high);
  }
  return box;
}

/// Diagonal of the box round the velocities of a group, mm/s.
double spread_of_velocities(const ContactFaces& faces, const State& state, int group) {
  const int first = faces.member_offset[group];
  const std::span<const int> members(&faces.member[first], faces.member_offset[group + 1] - first);
  const VelocityBox box =
      use_wide_kernels() ? box_of_velocities_wide(state, members) : box_of_velocities_plain(state, members);
  return (box.high - box.low).norm();
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

bool is_finite(const ContactFaces& faces, const State& state, int face) {
  return std::all_of(faces.particle.begin() + faces.offset[face], faces.particle.begin() + faces.offset[face + 1],
                     [&](int particle) { return state.position[particle].allFinite(); });
}

/// Faces of many corners are as large as the lattice, move as fast and are searched by a grid: rarely, with a wide skin.
double skin_of(const Scene& scene, int face) {
  return scene.faces.corner_count(face) < kManyCorners ? scene.contact.face_skin : kWideSkin * scene.contact.face_skin;
}

void make_list(const Scene& scene, State& state, int face) {
  const double skin = skin_of(scene, face);
  const FacePairs pairs = find_face_pairs(scene, state, face, skin);
  if (pairs.crossed) {
    give_up(state);
    return;
  }
  replace_list(state, face, pairs.candidates);
  // Of a face with candidates no more than the skin: an end that has gone through a segment is found while it is near.
  state.face_budget[face] = pairs.candidates.empty() ? pairs.least_gap : skin;
  for (int k = scene.faces.offset[face]; k < scene.faces.offset[face + 1]; ++k) {
    state.face_searched_position[k] = state.position[scene.faces.particle[k]];
  }
  ++state.face_search_count;
}

/// Sets the alarm of a face anew, with a list made anew if need be. A face with a particle that is lost stays as it is.
void look_at(const Scene& scene, State& state, int group, int face) {
  ++state.face_look_count;
  const double budget = state.face_budget[face];
  double left = budget;
  if (budget > 0.0) {
    left -= spread_of_displacements(scene.faces, state, face);
  }
  if (!is_finite(scene.faces, state, face)) {
    left = std::numeric_limits<double>::max();
  } else if (left <= kWorthAnotherLook * budget) {
    make_list(scene, state, face);
    if (state.crossing_step >= 0) {
      return;
    }
    left = state.face_budget[face];
  }
  state.face_alarm[face] = state.group_travel[group] + left;
}

void look_at_group(const Scene& scene, State& state, int group) {
  const int first = scene.faces.group_offset[group];
  const int end = scene.faces.group_offset[group + 1];
  for (int face = first; face < end; ++face) {
    if (state.face_alarm[face] <= state.group_travel[group]) {
      look_at(scene, state, group, face);
      if (state.crossing_step >= 0) {
        return;
      }
    }
  }
  // In a loop of its own, whose only number stays in a register.
  double least = std::numeric_limits<double>::max();
  for (int face = first; face < end; ++face) {
    least = std::min(least, state.face_alarm[face]);
  }
  state.group_alarm[group] = least;
}

}  // namespace

void search_faces(const Scene& scene, State& state, Workers& workers) {
  if (state.face_list.empty()) {
    begin(scene, state);
  }
  workers.share(state.group_travel.size(), [&](std::size_t first, std::size_t end) {
    for (std::size_t group = first; group < end; ++group) {
      const double spread = spread_of_velocities(scene.faces, state, static_cast<int>(group));
      state.group_travel[group] += std::isfinite(spread) ? scene.schedule.time_step * spread : 0.0;
    }
  });
  for (int group = 0; group < scene.faces.group_count() && state.crossing_step < 0; ++group) {
    if (state.group_alarm[group] <= state.group_travel[group]) {
      look_at_group(scene, state, group);
    }
  }
}

}  // namespace cellcrush
