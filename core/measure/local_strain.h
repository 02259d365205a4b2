#pragma once

#include <span>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/vector.h"
#include "measure/crush_mode.h"

namespace cellcrush {

/// The local strain of the cells of a lattice along the crush, 1 - |F e|: F is the deformation gradient that fits the
/// motion of the joints round a cell best in the sense of least squares, e the unit vector along the crush. It is the
/// nominal strain of a cell that does not turn, and 0 of one that only turns. Cells whose joints lie on a line have
/// none.
class LocalStrain {
 public:
  LocalStrain() = default;

  /// `faces` of the elements of the scene, or of one period (find_cells). REQUIRES: a scene with plates.
  LocalStrain(const Scene& scene, const Faces& faces);

  /// Overwrites the strains of all walls (Scene::wall_count), by their numbers (MeshView::element_wall): the mean of
  /// the cells that a wall borders, 0 if it borders none. Empty without cells.
  void evaluate(std::span<const Vector2> position, std::vector<float>& strains) const;

 private:
  struct Joint {
    int particle;
    double weight;  ///< 1/mm: F e is the sum of weights times positions
  };

  std::vector<int> offset_;       ///< C + 1, into joints_
  std::vector<Joint> joints_;     ///< of all cells
  std::vector<int> wall_offset_;  ///< C + 1, into walls_
  std::vector<int> walls_;        ///< numbers of the walls round each cell
  std::size_t wall_count_ = 0;
};

}  // namespace cellcrush
