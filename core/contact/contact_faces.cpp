#include "contact/contact_faces.h"

#include <algorithm>
#include <numeric>
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

/// The loops along the crush, the outer one last.
std::vector<std::size_t> order_of(const Scene& scene, const FaceLoops& loops) {
  std::vector<double> place(loops.count());
  for (std::size_t i = 0; i < loops.count(); ++i) {
    place[i] = scene.position[loops.particles_of(i).front()][scene.plates.axis];
  }
  std::vector<std::size_t> order(loops.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const bool a_is_outer = loops.area[a] < 0.0;
    const bool b_is_outer = loops.area[b] < 0.0;
    return a_is_outer != b_is_outer ? b_is_outer : !a_is_outer && place[a] < place[b];
  });
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
