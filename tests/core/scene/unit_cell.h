#pragma once

#include <Eigen/Dense>
#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {

/// The beams of a cell that repeats endlessly. Nodes are those of the cell; `along` leads from the start of a beam to
/// its end, which may be that of a neighbouring cell. Lengths in mm.
struct UnitCell {
  struct Beam {
    int start;
    int end;
    Vector2 along;
    double thickness;
  };
  int nodes = 0;
  double area = 0.0;  ///< 0 if none was found
  std::vector<Beam> beams;
};

/// Finds the smallest cell that repeats in the middle of a scene. Shares nothing with the solver but positions,
/// elements and thicknesses. REQUIRES: one lattice without imperfection, at least eight cells wide and high.
UnitCell find_unit_cell(const Scene& scene);

}  // namespace cellcrush
