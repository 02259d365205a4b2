#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "cellcrush/tuning.h"
#include "contact/search/candidate_lists.h"
#include "contact/search/face_pairs.h"
#include "contact/search/pair_search.h"
#include "contact/thickening.h"

namespace cellcrush {
namespace {

void begin(const FacesOfBand& faces, ContactLists& lists) {
  lists.face_list.resize(faces.count());
  for (int group = 0; group < faces.group_count(); ++group) {
    for (int face = faces.group_offset[group]; face < faces.group_offset[group + 1]; ++face) {
      lists.face_list[face].group = group;
    }
  }
  lists.face_clearance.assign(faces.count(), 0.0);
  lists.face_next_check_travel.assign(faces.count(), 0.0);
  lists.face_searched_position.assign(faces.particle.size(), Vector2::Zero());
  lists.face_searched_growth.assign(faces.count(), 0.0);
  lists.group_travel.assign(faces.group_count(), 0.0);
  lists.group_next_check_travel.assign(faces.group_count(), 0.0);
}

/// |v_high - v_low| of E8c, mm/s: the diagonal of the bounding box of the velocities of a group.
double spread_of_velocities(const FacesOfBand& faces, const State& state, int group) {
  const int first = faces.member_offset[group];
  const std::span<const int> members(&faces.member[first], faces.member_offset[group + 1] - first);
  const VelocityBox box = box_of_velocities(state, members);
  return (box.high - box.low).norm();
}

/// Diagonal of the bounding box of the displacements of a face's particles since its list was made, mm.
double spread_of_displacements(const FacesOfBand& faces, const State& state, const ContactLists& lists, int face) {
  const int first = faces.offset[face];
  Vector2 low = state.position[faces.particle[first]] - lists.face_searched_position[first];
  Vector2 high = low;
  for (int k = first + 1; k < faces.offset[face + 1]; ++k) {
    const Vector2 displacement = state.position[faces.particle[k]] - lists.face_searched_position[k];
    low = low.cwiseMin(displacement);
    high = high.cwiseMax(displacement);
  }
  return (high - low).norm();
}

bool is_finite(const FacesOfBand& faces, const State& state, int face) {
  return std::all_of(faces.particle.begin() + faces.offset[face], faces.particle.begin() + faces.offset[face + 1],
                     [&](int particle) { return state.position[particle].allFinite(); });
}

/// Faces of many corners are as large as the lattice, move as fast as it and are searched over a grid. A wide skin
/// makes this rare.
double skin_of(const Scene& scene, const FacesOfBand& faces, int face) {
  return has_many_corners(faces, face) ? kWideSkin * scene.contact.face_skin : scene.contact.face_skin;
}

/// Returns false if walls are found to have crossed; the list then stays as it is.
bool make_list(const Scene& scene, const State& state, const LatticeBand& band, const FacesOfBand& faces, int face,
               ContactLists& lists) {
  const double skin = skin_of(scene, faces, face);
  const FacePairs pairs = find_face_pairs(scene, state, band, faces, face, skin);
  if (pairs.crossed) {
    return false;
  }
  replace_list(lists, face, pairs.candidates);
  // With candidates, the clearance is at most the skin: an end that has gone through a segment is then found while it
  // is near.
  lists.face_clearance[face] = pairs.candidates.empty() ? pairs.least_gap : skin;
  for (int k = faces.offset[face]; k < faces.offset[face + 1]; ++k) {
    lists.face_searched_position[k] = state.position[faces.particle[k]];
  }
  lists.face_searched_growth[face] = lists.reach_growth;
  ++lists.face_search_count;
  return true;
}

/// Sets the next check of a face and rebuilds its list if needed. A face with a non-finite position stays as it is.
/// Returns false if walls are found to have crossed.
bool recheck_face(const Scene& scene, const State& state, const LatticeBand& band, const FacesOfBand& faces, int group,
                  int face, ContactLists& lists) {
  ++lists.face_recheck_count;
  const double clearance = lists.face_clearance[face];
  double left = clearance - spread_of_displacements(faces, state, lists, face) -
                (lists.reach_growth - lists.face_searched_growth[face]);
  if (!is_finite(faces, state, face)) {
    left = std::numeric_limits<double>::max();
  } else if (left <= kWorthKeeping * clearance) {
    if (!make_list(scene, state, band, faces, face, lists)) {
      lists.face_next_check_travel[face] = std::numeric_limits<double>::max();
      return false;
    }
    left = lists.face_clearance[face];
  }
  lists.face_next_check_travel[face] = lists.group_travel[group] + left;
  return true;
}

bool recheck_group(const Scene& scene, const State& state, const LatticeBand& band, const FacesOfBand& faces, int group,
                   ContactLists& lists) {
  const int first = faces.group_offset[group];
  const int end = faces.group_offset[group + 1];
  for (int face = first; face < end; ++face) {
    if (lists.face_next_check_travel[face] <= lists.group_travel[group] &&
        !recheck_face(scene, state, band, faces, group, face, lists)) {
      return false;
    }
  }
  // A loop of its own, with the minimum in a register.
  double least = std::numeric_limits<double>::max();
  for (int face = first; face < end; ++face) {
    least = std::min(least, lists.face_next_check_travel[face]);
  }
  lists.group_next_check_travel[group] = least;
  return true;
}

}  // namespace

bool search_faces(const Scene& scene, const State& state, std::size_t number, ContactLists& lists, Workers& workers) {
  const LatticeBand& band = scene.bands[number];
  const FacesOfBand& faces = scene.faces.bands[number];
  if (lists.face_list.empty()) {
    begin(faces, lists);
  }
  // The pairs of a band have elements of adjacent bands.
  const double growth =
      growth_of_reach(scene, state, number > 0 ? number - 1 : 0, std::min(number + 2, scene.bands.size()));
  lists.reach_growth += growth;
  workers.parallel_for(lists.group_travel.size(), [&](std::size_t first, std::size_t end) {
    for (std::size_t group = first; group < end; ++group) {
      const double spread = spread_of_velocities(faces, state, static_cast<int>(group));
      lists.group_travel[group] += growth + (std::isfinite(spread) ? scene.schedule.time_step * spread : 0.0);
    }
  });
  for (int group = 0; group < faces.group_count(); ++group) {
    if (lists.group_next_check_travel[group] <= lists.group_travel[group] &&
        !recheck_group(scene, state, band, faces, group, lists)) {
      return false;
    }
  }
  return true;
}

}  // namespace cellcrush
