#pragma once

#include <vector>

#include "cellcrush/sample.h"
#include "measure/faces.h"

namespace cellcrush {

// The crush mode: where the cells of a lattice collapse, after the words of Ruan, Lu, Wang and Yu, Int. J. Impact Eng.
// 28 (2003) 161-182, read on the undeformed lattice. A cell has collapsed when it has kCollapsedArea of its area or
// less.
//   I  bands straight across the crush
//   V  two oblique bands that meet in a point at an end, a side or inside, to either hand; also two or more V
//   X  two oblique bands that cross inside the lattice and go on behind the crossing on both sides
//   C  a curved band: a V whose point is turned round, as at an obstacle
// Each is a mid-line and a width along the crush. That of V is at |s - s0| = a |t - t0|, one hand of it; of a V that
// lies on a side and of X both hands; of C s - s0 = +-a (t - t0)^2 / (W / 2), with s along the crush, t across it, W
// the lattice's width. The band that agrees best is looked for over its place, slope and width; agreement is twice the
// collapsed cells within the band over the cells within it plus all collapsed ones (Dice's coefficient). Every arm of a
// band has to be there. What the first band leaves is looked at again while it is much, so that bands at both ends
// count as bands. The simplest kind wins unless another agrees better by kClearlyBetter. A lattice whose bands agree by
// less than kLeastAgreement, or whose bands are of several kinds, is MIXED. So is a single oblique band.

inline constexpr double kCollapsedArea = 0.5;
inline constexpr double kLeastAgreement = 0.6;
inline constexpr double kClearlyBetter = 0.03;

/// Shares of collapsed cells between which a crush shows its mode: fewer say little, more run together.
inline constexpr double kModeFrom = 0.10;
inline constexpr double kModeTo = 0.25;

/// Cells of a lattice in the frame of the crush, and which of them have collapsed. C cells.
struct CollapseField {
  std::vector<double> along;    ///< C, mm from the impact end, undeformed
  std::vector<double> across;   ///< C, mm from one side, undeformed
  std::vector<bool> collapsed;  ///< C
  double length = 0.0;          ///< mm, along the crush
  double width = 0.0;           ///< mm, across it
  double pitch = 0.0;           ///< mm, mean extent of a cell along the crush
};

/// Share of the cells that have collapsed; 0 without cells.
double collapsed_fraction_of(const CollapseField& field);

/// The kind of bands that the collapsed cells make. `agreement`, where given, takes how well they do. NONE without any.
CrushMode find_crush_mode(const CollapseField& field, double* agreement = nullptr);

}  // namespace cellcrush
