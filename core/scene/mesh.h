#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// A straight wall between two joints.
struct LayoutWall {
  int start = 0;
  int end = 0;
  double thickness = 0.0;  ///< mm
  int elements = 1;        ///< number of elements into which it is divided
  int material = 0;        ///< index into Scene::materials
  bool rigid = false;      ///< part of a rigid body: not divided
};

/// Joints and walls of a structure before it is divided into elements. Lengths in mm.
struct Layout {
  std::vector<Vector2> joints;
  std::vector<LayoutWall> walls;
};

/// Divides the walls into elements: fills the positions, elements and walls of the scene. Joints come first, then the
/// particles inside the walls, block by block. Consecutive walls with the same number of elements share a block. Each
/// rigid wall is one element, after all others. REQUIRES: rigid walls are the last ones.
void divide_walls(const Layout& layout, Scene& scene);

}  // namespace cellcrush
