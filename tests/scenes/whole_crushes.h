#pragma once

#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

struct WholeCrush {
  std::string name;
  SceneSpec spec;
};

/// Small specimens crushed to 60 %: lattices, rules, precisions, hardening, friction, damping, rigid cells, two
/// thicknesses, shear.
std::vector<WholeCrush> whole_crushes();

/// The specimen of them, at 100 m/s; lattices as in SmallSpecimen. Seven columns and five rows leave some walls over
/// after whole vectors.
SceneSpec whole_specimen(const char* lattice, double friction = 0.0);

}  // namespace cellcrush::scenes
