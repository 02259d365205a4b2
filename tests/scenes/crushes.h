#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// A spec with the paper's elements: displacement-based, Lobatto points through the depth, constant area.
SceneSpec with_the_papers_elements(SceneSpec spec);

/// Type I at 100 m/s to 80 % strain with the paper's elements and its step of 2e-7 s.
SceneSpec papers_type_i();

/// papers_type_i with `times` as many rows of cells: wider across the crush, so that the same strain crushes the same
/// share.
SceneSpec papers_type_i_wider(int times);

/// A crush that benchmarks time, under a name that stays.
struct Crush {
  std::string name;
  SceneSpec spec;
  std::vector<double> strains;  ///< at which its steps are timed, ascending
};
std::vector<Crush> crushes();

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
std::string name_of(const ::testing::TestParamInfo<SmallSpecimen>& test);

}  // namespace cellcrush::scenes
