#include "core/reference/reference_lattice.h"

#include <algorithm>

namespace cellcrush::reference {

Particles lump(const Lattice& lattice) {
  const std::size_t count = lattice.position.size();
  Particles particles = {std::vector<double>(count), std::vector<double>(count), std::vector<double>(count)};
  for (const Segment& segment : lattice.segments) {
    const double length = (lattice.position[segment.end] - lattice.position[segment.start]).norm();
    const double mass = segment.material.density * lattice.depth * segment.thickness * length / 2.0;  // Eq. 2, E1
    for (const int particle : {segment.start, segment.end}) {
      particles.mass[particle] += mass;
      particles.inertia[particle] += mass * segment.thickness * segment.thickness / 12.0;          // Eq. 3, E1
      particles.radius[particle] = std::max(particles.radius[particle], segment.thickness / 2.0);  // R of E8
    }
  }
  return particles;
}

}  // namespace cellcrush::reference
