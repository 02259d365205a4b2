#pragma once

#include <optional>

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

inline RegularLattice hexagons(int columns, int rows, double side_mm, double wall_thickness_mm,
                               std::optional<double> vertical_wall_thickness_mm = std::nullopt) {
  RegularLattice lattice = {"hexagon", columns, rows, side_mm, wall_thickness_mm, {}};
  if (vertical_wall_thickness_mm) lattice.own["vertical_wall_thickness_mm"] = *vertical_wall_thickness_mm;
  return lattice;
}

inline RegularLattice squares(int columns, int rows, double side_mm, double wall_thickness_mm) {
  return {"square", columns, rows, side_mm, wall_thickness_mm, {}};
}

inline RegularLattice triangles(int columns, int rows, double side_mm, double wall_thickness_mm) {
  return {"triangle", columns, rows, side_mm, wall_thickness_mm, {}};
}

/// The lattice of equal cells of a spec. REQUIRES: it has one.
inline RegularLattice& cells_of(SceneSpec& spec) { return std::get<RegularLattice>(spec.lattice); }

inline const RegularLattice& cells_of(const SceneSpec& spec) { return std::get<RegularLattice>(spec.lattice); }

}  // namespace cellcrush::scenes
