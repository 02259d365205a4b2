#pragma once

#include <span>
#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// The crush mode: where the cells of a lattice collapse, in the terms of Ruan, Lu, Wang and Yu, Int. J. Impact Eng. 28
// (2003) 161-182, shown on the undeformed lattice. A cell has collapsed when its area is at most kCollapsedArea of the
// undeformed one.
//   I  bands straight across the crush
//   V  two oblique bands that meet in a point at an end, at a side or inside, open to either direction; also several V
//   X  two oblique bands that cross inside the lattice and continue on both sides beyond the crossing
//   C  a curved band: a V with a rounded point, as at an obstacle
//
// Each has a mid-line and a width along the crush. s is the position along the crush, t that across it, and W the width
// of the lattice. The mid-lines are: of V, s - s0 = a |t - t0| with a of either sign; of X, and of a V with its point
// on a side, |s - s0| = a |t - t0|; of C, s - s0 = a (t - t0)^2 / (W / 2) with a of either sign.
//
// The band that agrees best is found by a search over position, slope and width. Agreement is Dice's coefficient: twice
// the number of collapsed cells in the band, over the number of its cells plus that of all collapsed cells. Every arm
// of a band must be present. As long as many collapsed cells are left, the search is repeated on them, so that bands at
// both ends count as bands. The simplest kind wins unless another agrees better by kClearlyBetter. The mode is MIXED if
// the agreement is less than kLeastAgreement, if bands are of several kinds, or if there is a single oblique band.

inline constexpr double kCollapsedArea = 0.5;
inline constexpr double kLeastAgreement = 0.6;
inline constexpr double kClearlyBetter = 0.03;

/// Range of the fraction of collapsed cells in which a crush shows its mode: with fewer cells there is little to see,
/// with more the bands merge.
inline constexpr double kModeFrom = 0.10;
inline constexpr double kModeTo = 0.25;

/// Cells of a lattice in coordinates of the crush, and which of them have collapsed. C cells.
struct CollapseField {
  std::vector<double> along;    ///< C, mm from the impact end, undeformed
  std::vector<double> across;   ///< C, mm from one side, undeformed
  std::vector<bool> collapsed;  ///< C
  double length = 0.0;          ///< mm, along the crush
  double width = 0.0;           ///< mm, across it
  double pitch = 0.0;           ///< mm, mean extent of a cell along the crush
};

/// Fraction of the cells that have collapsed; 0 without cells.
double collapsed_fraction_of(const CollapseField& field);

/// The kind of bands that the collapsed cells make; NONE if none has collapsed.
CrushMode find_crush_mode(const CollapseField& field);

/// The faces (cells) of a planar lattice: loops of particles, counter-clockwise. C faces.
struct Faces {
  std::vector<int> offset;      ///< C + 1, into particles
  std::vector<int> particles;   ///< the loops, one after another
  std::vector<int> elements;    ///< from each particle of a loop to the next one
  std::vector<double> area;     ///< C, mm^2, undeformed; positive
  std::vector<Vector2> centre;  ///< C, mm, undeformed: mean of the corners of the loop

  [[nodiscard]] std::span<const int> particles_of(std::size_t face) const {
    return std::span(particles).subspan(offset[face], offset[face + 1] - offset[face]);
  }
  [[nodiscard]] std::span<const int> elements_of(std::size_t face) const {
    return std::span(elements).subspan(offset[face], offset[face + 1] - offset[face]);
  }
  [[nodiscard]] std::size_t count() const { return area.size(); }
};

/// Traces the faces of the graph of particles and elements (contact/topology/face_loops.h), without the outer one.
/// REQUIRES: a planar drawing, in which elements meet only at particles.
Faces trace_faces(std::span<const Vector2> position, std::span<const Element> elements);

/// Areas of the faces at other positions of the same particles, divided by their undeformed areas, C. The area of a
/// face that is turned inside out is negative.
std::vector<double> area_ratios(const Faces& faces, std::span<const Vector2> position);

/// The cells of a lattice between plates.
struct Cells {
  Faces faces;
  CollapseField field;  ///< of the undeformed lattice, in which no cell has collapsed
};

/// Traces the cells. Where the sides repeat, those of one period: their particles have the numbers of Scene::repeated.
/// REQUIRES: a scene with plates.
Cells find_cells(const Scene& scene);

/// Where the particles of the cells are now.
std::span<const Vector2> places_of_cells(const Scene& scene, const State& state, std::vector<Vector2>& room);

/// The cells that have collapsed at other positions of the particles, those of a state or of a stored frame.
CollapseField find_collapse(const Cells& cells, std::span<const Vector2> position);

}  // namespace cellcrush
