#pragma once

#include <vector>

#include "cellcrush/sample.h"

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

}  // namespace cellcrush
