
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

#include "cellcrush/tuning.h"
#include "contact/topology/bands.h"
#include "contact/topology/face_loops.h"
#include "geometry/find_parts.h"

namespace cellcrush {
namespace {

using Premise = ContactFaces::Premise;

int faces_per_group(const Scene& scene) { return scene.bands.size() > 1 ? kFacesPerGroupOfBands : kFacesPerGroup; }

/// Whether no loop comes twice to the same particle.
bool are_simple(const std::vector<FaceLoop>& loops, std::size_t particle_count) {
  std::vector<const FaceLoop*> seen_by(particle_count, nullptr);
  for (const FaceLoop& loop : loops) {
    for (const int particle : loop.particle) {
      if (std::exchange(seen_by[particle], &loop) == &loop) {
        return false;
      }
    }
  }
  return true;
}

Premise premise_of(const Scene& scene, const std::vector<FaceLoop>& loops) {
  const std::vector<int> parts = find_parts(scene.particle_count(), scene.elements);
  if (std::ranges::count(parts, 0) != std::ssize(parts)) {
    return Premise::several_parts;
  }
  const bool euler = scene.particle_count() + loops.size() == scene.element_count() + 2;
  const auto borders = std::ranges::count_if(loops, &FaceLoop::is_outer);
  if (!euler || borders > 1) {
    return Premise::not_planar;
  }
  return borders == 1 && are_simple(loops, scene.particle_count()) ? Premise::holds : Premise::not_closed;
}

/// The first of the bands whose particles are at a loop.
int band_of_loop(const FaceLoop& loop, const std::vector<int>& band_of) {
  return band_of[std::ranges::min(loop.particle, {}, [&](int particle) { return band_of[particle]; })];
}

/// The loops in patches of faces that are watched together, strip by strip along the crush in each band, the outer one
/// last.
std::vector<std::size_t> order_of(const Scene& scene, const std::vector<FaceLoop>& loops,
                                  const std::vector<int>& band_of) {
  const auto corner_of = [&](const FaceLoop& loop) { return scene.position[loop.particle.front()]; };
  Vector2 low = corner_of(loops.front());
  Vector2 high = low;
  for (const FaceLoop& loop : loops) {
    low = low.cwiseMin(corner_of(loop));
    high = high.cwiseMax(corner_of(loop));
  }
  const double area_of_patch = faces_per_group(scene) * (high - low).prod() / static_cast<double>(loops.size());
  const double strip = std::sqrt(area_of_patch / kPatchAspect);
  const int axis = scene.plates.axis;
  // Whether outer, band, strip, place across and along the crush, number.
  std::vector<std::tuple<bool, int, double, double, double, std::size_t>> keys;
  for (const FaceLoop& loop : loops) {
    const Vector2 from_low = corner_of(loop) - low;
    const double strips = strip > 0.0 ? std::floor(from_low[axis] / strip) : 0.0;
    keys.emplace_back(loop.is_outer(), band_of_loop(loop, band_of), strips, from_low[1 - axis], from_low[axis],
                      keys.size());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  std::ranges::transform(keys, std::back_inserter(order), [](const auto& key) { return std::get<5>(key); });
  return order;
}

/// Puts a loop last among a band's faces: its corners and thick ends whose elements have both ends in, so that no
/// segment leads out.
template <class IsIn>
void add_face(const Scene& scene, const FaceLoop& loop, int number, const IsIn& is_in, FacesOfBand& faces) {
  if (faces.offset.empty()) {
    faces.offset.push_back(0);
  }
  if (loop.is_outer() || faces.group_offset.empty() ||
      faces.count() - faces.group_offset.back() == faces_per_group(scene)) {
    faces.group_offset.push_back(faces.count());
  }
  for (std::size_t k = 0; k < loop.element.size(); ++k) {
    const Element& element = scene.elements[loop.element[k]];
    if (is_in(element.start) && is_in(element.end)) {
      faces.particle.push_back(loop.particle[k]);
      faces.element.push_back(loop.element[k]);
    }
    if (k + 1 == loop.corners) {
      faces.corner_end.push_back(static_cast<int>(faces.particle.size()));
    }
  }
  faces.number.push_back(number);
  faces.offset.push_back(static_cast<int>(faces.particle.size()));
}

void note_sides(const Scene& scene, const FaceLoop& loop, int number, ContactFaces& faces) {
  for (std::size_t k = 0; k < loop.element.size(); ++k) {
    const int e = loop.element[k];
    if (k < loop.corners) {
      faces.side[2 * e + (scene.elements[e].start == loop.particle[k] ? 0 : 1)] = number;
    } else {
      faces.thick_ends.push_back({e, number});
    }
  }
}

/// Every loop goes to the first of the bands whose particles are at it; the outer one, in parts, to all.
void take_faces(const Scene& scene, const std::vector<FaceLoop>& loops, const std::vector<int>& band_of,
                ContactFaces& faces) {
  const auto bands = static_cast<int>(scene.bands.size());
  faces.bands.resize(bands);
  faces.side.assign(2 * scene.element_count(), -1);
  int number = 0;
  for (const std::size_t i : order_of(scene, loops, band_of)) {
    const FaceLoop& loop = loops[i];
    note_sides(scene, loop, number, faces);
    const int home = band_of_loop(loop, band_of);
    for (int band = loop.is_outer() ? 0 : home; band < (loop.is_outer() ? bands : home + 1); ++band) {
      const auto is_in = [&](int particle) { return !loop.is_outer() || std::abs(band_of[particle] - band) <= 1; };
      add_face(scene, loop, number, is_in, faces.bands[band]);
    }
    ++number;
  }
  std::ranges::stable_sort(faces.thick_ends, {}, &ThickEnd::element);
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

/// The particles on the outer border of a lattice, band by band.
std::vector<BorderParticle> find_border(const Scene& scene, const std::vector<int>& band_of) {
  const std::vector<int> of_element = bands_of_elements(scene, scene.bands);
  std::vector<BorderParticle> border;
  for (int band = 0; band < static_cast<int>(scene.bands.size()); ++band) {
    const FacesOfBand& faces = scene.faces.bands[band];
    for (int k = faces.offset[faces.count() - 1]; k < faces.offset[faces.count()]; ++k) {
      const int particle = faces.particle[k];
      if (band_of[particle] == band) {
        const int last = scene.incidence[scene.incidence_offset[particle + 1] - 1];  // incidence is ascending
        border.push_back({particle, band, of_element[last]});
      }
    }
  }
  return border;
}

}  // namespace

void build_contact_faces(Scene& scene) {
  std::vector<FaceLoop> loops = trace_loops(scene.position, scene.elements);
  ContactFaces& faces = scene.faces;
  faces.premise = premise_of(scene, loops);
  if (!faces.are_enough()) {
    return;
  }
  for (FaceLoop& loop : loops) {
    append_thick_ends(scene, loop);
  }
  scene.bands = cut_into_bands(scene, loops);
  const std::vector<int> band_of = bands_of_particles(scene, scene.bands);
  take_faces(scene, loops, band_of, faces);
  std::vector<int> seen(scene.particle_count(), -1);
  int number = 0;
  for (FacesOfBand& of_band : faces.bands) {
    note_members(seen, number, of_band);
  }
  if (scene.bands.size() > 1) {
    faces.border = find_border(scene, band_of);
  }
}

}  // namespace cellcrush
