#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// A straight wall between two joints.
struct Wall {
  int start = 0;
  int end = 0;
  double thickness = 0.0;  ///< mm
  int elements = 1;        ///< elements it is divided into
  int material = 0;        ///< into Scene::materials
};

/// Joints and walls of a structure before it is divided into elements. Lengths in mm.
struct Layout {
  std::vector<Vector2> joints;
  std::vector<Wall> walls;
};

/// Particles and elements. The joints come first, then the particles inside the walls, wall by wall; the elements of a wall
/// follow each other from its start to its end.
struct Mesh {
  std::vector<Vector2> position;
  std::vector<Element> elements;
};

Mesh divide_walls(const Layout& layout);

}  // namespace cellcrush
