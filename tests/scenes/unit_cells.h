#pragma once

#include <numbers>

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// Unit cells of lattices as explicit frames. Under even strain the middle of every wall is a centre of inversion: no
/// moment there, and it moves as the strain says; a cell is a joint with its half walls.
struct UnitCell {
  static constexpr double kSide = 10.0;  // L, mm
  static constexpr double kModulus = 70000.0;
  static constexpr double kHexagonHeight = 0.75 * kSide;                       // of the half cell below
  static constexpr double kHexagonWidth = 0.25 * std::numbers::sqrt3 * kSide;  // mm
  static constexpr double kTriangleArea = 0.5 * std::numbers::sqrt3 * kSide * kSide;
  static constexpr double kSquareArea = kSide * kSide;

  /// Half of a hexagon's cell, cut along its vertical wall: the wall's middle stands, the joint neither turns nor
  /// leaves the cut, and the middle of the slanted wall, which is watched, bears a dead load in N. A stress s in MPa is
  /// a load (1.5 L s, 0) along x, (0, L cos 30 s) along y.
  static SceneSpec loaded_hexagon(double thickness, double load_x, double load_y);

  /// The same cell, perfectly plastic, its watched node pushed down to a strain.
  static SceneSpec crushed_hexagon(double thickness, double yield_stress, double strain, int elements,
                                   const SectionSpec& section);

  /// A joint of triangles (walls along x and at 60 and 120 degrees) or of squares, the middles of its walls moved as an
  /// even strain says.
  static SceneSpec strained_triangle(double thickness, double strain_x, double strain_y);
  static SceneSpec strained_square(double thickness, double strain_x, double strain_y);

  /// A specimen of hexagons with free sides, `columns` cells wide and endless along y: the zigzag between two lines of
  /// symmetry, of height 1.5 L and width sqrt 3 L columns, strained along y.
  static SceneSpec strained_hexagon_strip(double thickness, int columns, double strain);
};

}  // namespace cellcrush::scenes
