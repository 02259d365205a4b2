#pragma once

#include <optional>
#include <vector>

#include "cellcrush/v1/case.pb.h"
#include "drawing/bond_walls.h"
#include "drawing/drawing.h"

namespace cellcrush::drawing {

/// How a drawing becomes a network.
struct JoinOptions {
  double mm_per_unit = 1.0;
  /// Within which places are one joint; default: kTolerance of the shortest wall.
  std::optional<double> tolerance_mm = {};
  std::optional<double> thickness_mm = {};  ///< of walls whose file does not say it
  double bond = kBondTolerance;             ///< see bond_walls; 0: no walls are bonded
  bool joins_crossings = true;              ///< whether walls that cross are joined there
};

inline constexpr double kTolerance = 1e-3;

/// A network, and what was done to the drawing. Places in mm.
struct JoinedWalls {
  v1::Lattice::Network network;
  double tolerance_mm = 0.0;
  int merged = 0;                      ///< ends of walls that became one joint, less one for each joint
  int without_length = 0;              ///< walls without length, left out
  int divided = 0;                     ///< ends that met a wall between its joints, which was divided there
  std::vector<Bond> bonds;             ///< where walls face to face became one
  std::vector<DrawnPlace> duplicates;  ///< middles of walls that were drawn twice, left out
  std::vector<DrawnPlace> covered;     ///< middles of parts of walls that were drawn on other walls, left out
  std::vector<DrawnPlace> crossings;   ///< where walls cross that are joined there, or are not
  std::vector<DrawnPlace> loose;       ///< joints with one wall
  std::vector<DrawnPlace> islands;     ///< a joint of each part but the largest
};

/// Bonds walls face to face, joins the ends of walls that lie within the tolerance of each other, divides walls where
/// ends of others meet them and, if asked, where they cross, and leaves out what is there twice. Joints are numbered in
/// the order of the walls. Throws DrawingError if a wall has no thickness, or nothing is left, and for a drawing that
/// is too large or too dense.
JoinedWalls join_walls(const Drawing& drawing, const JoinOptions& options);

}  // namespace cellcrush::drawing
