#include "bench/array_bytes.h"

#include <algorithm>

namespace cellcrush::bench {
namespace {

template <class Array>
double bytes_of(const Array& array) {
  return static_cast<double>(array.capacity() * sizeof(array[0]));
}

}  // namespace

std::vector<std::pair<std::string, double>> array_bytes(const Scene& scene, const State& state) {
  std::vector<std::pair<std::string, double>> arrays = {
      {"scene.position", bytes_of(scene.position)},
      {"scene.mass", bytes_of(scene.mass)},
      {"scene.inertia", bytes_of(scene.inertia)},
      {"scene.inverse_mass", bytes_of(scene.inverse_mass)},
      {"scene.inverse_inertia", bytes_of(scene.inverse_inertia)},
      {"scene.radius", bytes_of(scene.radius)},
      {"scene.elements", bytes_of(scene.elements)},
      {"scene.walls", bytes_of(scene.walls.blocks) + bytes_of(scene.walls.start) + bytes_of(scene.walls.end) +
                          bytes_of(scene.walls.thickness) + bytes_of(scene.walls.undeformed_length) +
                          bytes_of(scene.walls.material) + bytes_of(scene.walls.chunk_offset) +
                          bytes_of(scene.walls.first_joint) + bytes_of(scene.walls.end_joint)},
      {"scene.rigid", bytes_of(scene.rigid.offset) + bytes_of(scene.rigid.centre) + bytes_of(scene.rigid.mass) +
                          bytes_of(scene.rigid.inertia)},
      {"scene.incidence", bytes_of(scene.incidence_offset) + bytes_of(scene.incidence)},
      {"scene.wall_ends", bytes_of(scene.wall_end_offset) + bytes_of(scene.wall_ends)},
      {"scene.supports", bytes_of(scene.supports)},
      {"scene.initial_velocity", bytes_of(scene.initial_velocity) + bytes_of(scene.initial_spin)},
      {"scene.limited_reaches", bytes_of(scene.limited_reaches.offset) + bytes_of(scene.limited_reaches.segment) +
                                    bytes_of(scene.limited_reaches.reach)},
      {"scene.faces", bytes_of(scene.faces.side) + bytes_of(scene.faces.border)},
  };
  for (const FacesOfBand& faces : scene.faces.bands) {
    arrays.emplace_back("scene.faces", bytes_of(faces.number) + bytes_of(faces.offset) + bytes_of(faces.particle) +
                                           bytes_of(faces.element) + bytes_of(faces.group_offset) +
                                           bytes_of(faces.member_offset) + bytes_of(faces.member));
  }
  visit_fields(state, [&](const char* name, const auto& field) {
    if constexpr (requires { field.data(); }) {
      arrays.emplace_back(std::string("state.") + name, bytes_of(field));
    }
  });
  std::sort(arrays.begin(), arrays.end(), [](const auto& one, const auto& other) { return one.second > other.second; });
  return arrays;
}

}  // namespace cellcrush::bench
