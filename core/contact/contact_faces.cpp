#include "contact/contact_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include "scene/face_loops.h"

namespace cellcrush {
namespace {

using Premise = ContactFaces::Premise;

/// Faces that are watched together.
constexpr int kFacesPerGroup = 64;

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

/// Length across the crush of a patch of neighbouring faces, over its length along the crush: at the front, faces side by
/// side move alike, and faces behind each other do not.
constexpr double kPatchAspect = 7.0;

/// The loops in patches of faces that are watched together, band by band along the crush, the outer one last.
std::vector<std::size_t> order_of(const Scene& scene, const FaceLoops& loops) {
  const auto corner_of = [&](std::size_t loop) { return scene.position[loops.particles_of(loop).front()]; };
  Vector2 low = corner_of(0);
  Vector2 high = low;
  for (std::size_t i = 1; i < loops.count(); ++i) {
    low = low.cwiseMin(corner_of(i));
    high = high.cwiseMax(corner_of(i));
  }
  const double area_of_patch = kFacesPerGroup * (high - low).prod() / static_cast<double>(loops.count());
  const double band = std::sqrt(area_of_patch / kPatchAspect);
  const int axis = scene.plates.axis;
  struct Place {
    bool is_outer;
    double band;
    double across;
    double along;
    bool operator<(const Place& other) const {
      return std::tie(is_outer, band, across, along) < std::tie(other.is_outer, other.band, other.across, other.along);
    }
  };
  std::vector<Place> place(loops.count());
  for (std::size_t i = 0; i < loops.count(); ++i) {
    const Vector2 from_low = corner_of(i) - low;
    const double bands = band > 0.0 ? std::floor(from_low[axis] / band) : 0.0;
    place[i] = {loops.area[i] < 0.0, bands, from_low[1 - axis], from_low[axis]};
  }
  std::vector<std::size_t> order(loops.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place[a] < place[b]; });
  return order;
}

void take_faces(const Scene& scene, const FaceLoops& loops, ContactFaces& faces) {
  faces.offset.push_back(0);
  faces.side.assign(2 * scene.element_count(), -1);
  for (const std::size_t loop : order_of(scene, loops)) {
    const int face = faces.count();
    for (int k = loops.offset[loop]; k < loops.offset[loop + 1]; ++k) {
      faces.particle.push_back(loops.particle[k]);
      faces.element.push_back(loops.element[k]);
      const bool at_left = scene.elements[loops.element[k]].start == loops.particle[k];
      faces.side[2 * loops.element[k] + (at_left ? 0 : 1)] = face;
    }
    faces.offset.push_back(static_cast<int>(faces.particle.size()));
  }
}

void group_faces(const Scene& scene, ContactFaces& faces) {
  const int outer = faces.count() - 1;
  for (int face = 0; face < outer; face += kFacesPerGroup) {
    faces.group_offset.push_back(face);
  }
  faces.group_offset.push_back(outer);
  faces.group_offset.push_back(outer + 1);
  faces.member_offset.push_back(0);
  std::vector<int> seen(scene.particle_count(), -1);
  for (int group = 0; group < faces.group_count(); ++group) {
    for (int k = faces.offset[faces.group_offset[group]]; k < faces.offset[faces.group_offset[group + 1]]; ++k) {
      if (seen[faces.particle[k]] != group) {
        seen[faces.particle[k]] = group;
        faces.member.push_back(faces.particle[k]);
      }
    }
    std::sort(faces.member.begin() + faces.member_offset.back(), faces.member.end());
    faces.member_offset.push_back(static_cast<int>(faces.member.size()));
  }
}

}  // namespace

ContactFaces build_contact_faces(const Scene& scene) {
  const FaceLoops loops = trace_loops(scene.position, scene.elements);
  ContactFaces faces;
  faces.premise = premise_of(scene, loops);
  if (faces.are_enough()) {
    take_faces(scene, loops, faces);
    group_faces(scene, faces);
  }
  return faces;
}

}  // namespace cellcrush
