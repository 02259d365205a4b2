#include "scene/mesh_size.h"

#include <algorithm>

namespace cellcrush {

double count_elements(const FrameLattice& frame, int elements_per_wall) {
  double elements = 0.0;
  for (const FrameLattice::Beam& beam : frame.beams) {
    elements += std::max(1, beam.elements.value_or(elements_per_wall));
  }
  return elements;
}

double count_elements(const SceneSpec& spec) {
  const int elements_per_wall = *spec.elements_per_wall;
  const auto count = [&](double walls_per_cell, const auto& lattice) {
    return count_elements(walls_per_cell, *lattice.columns, *lattice.rows, elements_per_wall);
  };
  if (const auto* hexagon = std::get_if<HexagonLattice>(&spec.lattice)) {
    return count(kWallsOfHexagon, *hexagon);
  }
  if (const auto* square = std::get_if<SquareLattice>(&spec.lattice)) {
    return count(kWallsOfSquare, *square);
  }
  if (const auto* triangle = std::get_if<TriangleLattice>(&spec.lattice)) {
    return count(kWallsOfTriangle, *triangle);
  }
  return count_elements(std::get<FrameLattice>(spec.lattice), elements_per_wall);
}

}  // namespace cellcrush
