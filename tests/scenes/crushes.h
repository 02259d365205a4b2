#pragma once

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

}  // namespace cellcrush::scenes
