#include "scene/contact_faces.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "cellcrush/tuning.h"
#include "scene/bands.h"
#include "scene/border.h"
#include "scene/face_loops.h"
#include "scene/thick_ends.h"

namespace cellcrush {
namespace {

using Premise = ContactFaces::Premise;

int faces_per_group(const Scene& scene) { return scene.bands.size() > 1 ? kFacesPerGroupOfBands : kFacesPerGroup; }

bool is_one_part(const Scene& scene) {
  std::vector<bool> reached(scene.particle_count(), false);
  std::vector<int> next = {0};
  reached[0] = true;
  std::size_t count = 1;
  while (!next.empty()) {
    const int particle = next.back();
    next.pop_back();
    for (int k = scene.incidence_offset[particle]; k < scene.incidence_offset[particle + 1]; ++k) {
      const Element& element = scene.elements[scene.incidence[k]];
      const int other = element.start == particle ? element.end : element.start;
      if (!reached[other]) {
        reached[other] = true;
        ++count;
        next.push_back(other);
      }
    }
  }
  return count == scene.particle_count();
}

/// Whether no loop comes twice to the same particle.
bool are_simple(const FaceLoops& loops, std::size_t particle_count) {
  std::vector<int> seen(particle_count, -1);
  for (std::size_t i = 0; i < loops.count(); ++i) {
    for (const int particle : loops.particles_of(i)) {
      if (seen[particle] == static_cast<int>(i)) {
        return false;
      }
      seen[particle] = static_cast<int>(i);
    }
  }
  return true;
}

Premise premise_of(const Scene& scene, const FaceLoops& loops) {
  if (!is_one_part(scene)) {
    return Premise::several_parts;
  }
  const bool euler = scene.particle_count() + loops.count() == scene.element_count() + 2;
  const auto borders = std::count_if(loops.area.begin(), loops.area.end(), [](double area) { return area < 0.0; });
  if (!euler || borders > 1) {
    return Premise::not_planar;
  }
  return borders == 1 && are_simple(loops, scene.particle_count()) ? Premise::holds : Premise::not_closed;
}

/// The first of the bands whose particles are at a loop.
int band_of_loop(const FaceLoops& loops, const std::vector<int>& band_of, std::size_t loop) {
  int first = band_of[loops.particles_of(loop).front()];
  for (const int particle : loops.particles_of(loop)) {
    first = std::min(first, band_of[particle]);
  }
  return first;
}

/// The loops in patches of faces that are watched together, strip by strip along the crush in each band, the outer one
/// last.
std::vector<std::size_t> order_of(const Scene& scene, const FaceLoops& loops, const std::vector<int>& band_of) {
  const auto corner_of = [&](std::size_t loop) { return scene.position[loops.particles_of(loop).front()]; };
  Vector2 low = corner_of(0);
  Vector2 high = low;
  for (std::size_t i = 1; i < loops.count(); ++i) {
    low = low.cwiseMin(corner_of(i));
    high = high.cwiseMax(corner_of(i));
  }
  const double area_of_patch = faces_per_group(scene) * (high - low).prod() / static_cast<double>(loops.count());
  const double strip = std::sqrt(area_of_patch / kPatchAspect);
  const int axis = scene.plates.axis;
  struct Place {
    bool is_outer;
    int band;
    double strip;
    double across;
    double along;
    bool operator<(const Place& other) const {
      return std::tie(is_outer, band, strip, across, along) <
             std::tie(other.is_outer, other.band, other.strip, other.across, other.along);
    }
  };
  std::vector<Place> place(loops.count());
  for (std::size_t i = 0; i < loops.count(); ++i) {
    const Vector2 from_low = corner_of(i) - low;
    const double strips = strip > 0.0 ? std::floor(from_low[axis] / strip) : 0.0;
    place[i] = {loops.area[i] < 0.0, band_of_loop(loops, band_of, i), strips, from_low[1 - axis], from_low[axis]};
  }
  std::vector<std::size_t> order(loops.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place[a] < place[b]; });
  return order;
}

/// Puts a loop last among a band's faces: its corners and thick ends whose elements have both ends in, so that no
/// segment leads out.
template <class IsIn>
void add_face(const Scene& scene, const FaceLoops& loops, std::size_t loop, int number, bool is_alone,
              int most_in_group, const IsIn& is_in, FacesOfBand& faces) {
  if (faces.offset.empty()) {
    faces.offset.push_back(0);
  }
  if (is_alone || faces.group_offset.empty() || faces.count() - faces.group_offset.back() == most_in_group) {
    faces.group_offset.push_back(faces.count());
  }
  const auto add = [&](int first, int end) {
    for (int k = first; k < end; ++k) {
      const Element& element = scene.elements[loops.element[k]];
      if (is_in(element.start) && is_in(element.end)) {
        faces.particle.push_back(loops.particle[k]);
        faces.element.push_back(loops.element[k]);
      }
    }
  };
  add(loops.offset[loop], loops.end_of_corners(loop));
  faces.corner_end.push_back(static_cast<int>(faces.particle.size()));
  add(loops.end_of_corners(loop), loops.offset[loop + 1]);
  faces.number.push_back(number);
  faces.offset.push_back(static_cast<int>(faces.particle.size()));
}

void note_sides(const Scene& scene, const FaceLoops& loops, std::size_t loop, int number, ContactFaces& faces) {
  for (int k = loops.offset[loop]; k < loops.end_of_corners(loop); ++k) {
    const bool at_left = scene.elements[loops.element[k]].start == loops.particle[k];
    faces.side[2 * loops.element[k] + (at_left ? 0 : 1)] = number;
  }
  for (int k = loops.end_of_corners(loop); k < loops.offset[loop + 1]; ++k) {
    faces.thick_ends.push_back({loops.element[k], number});
  }
}

/// Every loop goes to the first of the bands whose particles are at it; the outer one, in parts, to all.
void take_faces(const Scene& scene, const FaceLoops& loops, const std::vector<int>& band_of, ContactFaces& faces) {
  const auto bands = static_cast<int>(scene.bands.size());
  faces.bands.resize(bands);
  faces.side.assign(2 * scene.element_count(), -1);
  int number = 0;
  for (const std::size_t loop : order_of(scene, loops, band_of)) {
    note_sides(scene, loops, loop, number, faces);
    const bool is_outer = loops.area[loop] < 0.0;
    const int home = band_of_loop(loops, band_of, loop);
    for (int band = is_outer ? 0 : home; band < (is_outer ? bands : home + 1); ++band) {
      const auto is_in = [&](int particle) { return !is_outer || std::abs(band_of[particle] - band) <= 1; };
      add_face(scene, loops, loop, number, is_outer, faces_per_group(scene), is_in, faces.bands[band]);
    }
    ++number;
  }
  std::stable_sort(faces.thick_ends.begin(), faces.thick_ends.end(),
                   [](const ThickEnd& a, const ThickEnd& b) { return a.element < b.element; });
  for (FacesOfBand& of_band : faces.bands) {
    of_band.group_offset.push_back(of_band.count());
    of_band.is_outer_whole = bands == 1;
  }
}

/// `seen`, of every particle, is the number of the group that has had it last, among those of all bands; `number` that
/// of the next.
void note_members(std::vector<int>& seen, int& number, FacesOfBand& faces) {
  faces.member_offset.push_back(0);
  for (int group = 0; group < faces.group_count(); ++group) {
    for (int k = faces.offset[faces.group_offset[group]]; k < faces.offset[faces.group_offset[group + 1]]; ++k) {
      if (seen[faces.particle[k]] != number) {
        seen[faces.particle[k]] = number;
        faces.member.push_back(faces.particle[k]);
      }
    }
    std::sort(faces.member.begin() + faces.member_offset.back(), faces.member.end());
    faces.member_offset.push_back(static_cast<int>(faces.member.size()));
    ++number;
  }
}

}  // namespace

void build_contact_faces(Scene& scene) {
  FaceLoops loops = trace_loops(scene.position, scene.elements);
  ContactFaces& faces = scene.faces;
  faces.premise = premise_of(scene, loops);
  if (!faces.are_enough()) {
    return;
  }
  append_thick_ends(scene, loops);
  scene.bands = cut_into_bands(scene, loops);
  take_faces(scene, loops, bands_of_particles(scene, scene.bands), faces);
  std::vector<int> seen(scene.particle_count(), -1);
  int number = 0;
  for (FacesOfBand& of_band : faces.bands) {
    note_members(seen, number, of_band);
  }
  if (scene.bands.size() > 1) {
    faces.border = find_border(scene);
  }
}

}  // namespace cellcrush
