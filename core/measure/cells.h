#pragma once

#include <span>
#include <vector>

#include "cellcrush/scene.h"
#include "measure/crush_mode.h"

namespace cellcrush {

/// The faces (cells) of a planar lattice: loops of particles, counter-clockwise. C faces.
struct Faces {
  std::vector<int> offset;      ///< C + 1, into particles
  std::vector<int> particles;   ///< the loops, one after another
  std::vector<double> area;     ///< C, mm^2, undeformed; positive
  std::vector<Vector2> centre;  ///< C, mm, undeformed: mean of the corners of the loop

  [[nodiscard]] std::span<const int> particles_of(std::size_t face) const {
    return std::span(particles).subspan(offset[face], offset[face + 1] - offset[face]);
  }
  [[nodiscard]] std::size_t count() const { return area.size(); }
};

/// Traces the faces of the graph of particles and elements (contact/topology/face_loops.h), without the outer one.
/// REQUIRES: a planar drawing, in which elements meet only at particles.
Faces trace_faces(std::span<const Vector2> position, std::span<const Element> elements);

/// Areas of the faces at other positions of the same particles, divided by their undeformed areas, C. The area of a
/// face that is turned inside out is negative.
std::vector<double> area_ratios(const Faces& faces, std::span<const Vector2> position);

/// The cells of a lattice between plates.
struct Cells {
  Faces faces;
  CollapseField field;  ///< of the undeformed lattice, in which no cell has collapsed
};

/// Traces the cells. REQUIRES: a scene with plates.
Cells find_cells(const Scene& scene);

/// The cells that have collapsed at other positions of the particles, those of a state or of a stored frame.
CollapseField find_collapse(const Cells& cells, std::span<const Vector2> position);

}  // namespace cellcrush
