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
  int elements = 1;        ///< elements it is divided into
  int material = 0;        ///< into Scene::materials
  bool rigid = false;      ///< part of a rigid body: not divided
};

/// Joints and walls of a structure before it is divided into elements. Lengths in mm.
struct Layout {
  std::vector<Vector2> joints;
  std::vector<LayoutWall> walls;
};

/// Divides the walls into elements: fills the scene's positions, elements and walls. The joints come first, then the
/// particles inside the walls, block by block. Walls that follow each other and have equally many elements share a
/// block. Rigid walls are an element each, behind all others. REQUIRES: they are the last.
void divide_walls(const Layout& layout, Scene& scene);

}  // namespace cellcrush
