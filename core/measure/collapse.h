#pragma once

#include <span>

#include "cellcrush/scene.h"
#include "measure/crush_mode.h"
#include "measure/faces.h"

namespace cellcrush {

/// The cells of a lattice between plates.
struct Cells {
  Faces faces;
  CollapseField field;  ///< of the undeformed lattice, in which no cell has collapsed
};

/// Traces the cells. REQUIRES: a scene with plates.
Cells find_cells(const Scene& scene);

/// The cells that have collapsed at other positions of the particles, those of a state or of a stored frame.
CollapseField find_collapse(const Cells& cells, std::span<const Vector2> position);

/// The positions of a stored frame.
std::vector<Vector2> positions_of(const FieldFrame& frame);

}  // namespace cellcrush
