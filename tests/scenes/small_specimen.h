#pragma once

#include <gtest/gtest.h>

#include <string>

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// A small specimen at relative density 0.1 and how it is crushed; "hexagon", "square", "triangle", or hexagons with
/// thicker vertical walls: "thick" with 0.25 and 0.5 mm, "thick_ends" with 0.5 and 0.9 mm, crushed along them.
struct SmallSpecimen {
  const char* lattice;
  double speed;      // m/s
  double friction;   // of walls and plates
  int elements = 0;  // per wall; 0: 2 of hexagons, 8 of squares and triangles
};

/// The specimen with a small imperfection and the chosen step.
SceneSpec spec_of(const SmallSpecimen& specimen, int columns, int rows);

/// Names the instance of a test.
std::string name_of(const testing::TestParamInfo<SmallSpecimen>& test);

}  // namespace cellcrush::scenes
