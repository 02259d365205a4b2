#pragma once

#include <optional>

#include "cellcrush/scene_spec.h"
#include "lattice/cut_walls.h"
#include "lattice/layout.h"

namespace cellcrush {

/// A Voronoi honeycomb, cut at its rectangle.
struct VoronoiLayout {
  Layout layout;
  Islands islands;         ///< not counted where it repeats
  double thickness = 0.0;  ///< mm, of all walls
};

/// Joints and walls between the cells of the nuclei (lattice/nuclei.h), after Lloyd's relaxation (Lloyd, 1982). The
/// same lattice gives the same bits on every machine: nuclei are whole numbers, which cells meet is decided exactly
/// (Boost.Polygon), and the place of a joint, the centre of the circle through three nuclei, is one quotient of exact
/// integers. Along an axis on which it repeats it is not cut: each wall of a period stands once, and some lead from one
/// into the next. REQUIRES: a checked lattice.
VoronoiLayout lay_out_voronoi(const VoronoiWalls& lattice, std::optional<int> repeats_along = std::nullopt);

/// Extent of the rectangle, mm.
Vector2 envelope_of(const VoronoiWalls& lattice);

/// Number of elements: regular hexagons have three walls a cell, and others have as many.
double count_elements(const VoronoiWalls& lattice, int elements_per_wall);

}  // namespace cellcrush
