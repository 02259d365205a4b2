#pragma once

#include <numbers>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Stress of a wall that is held along the depth over the equivalent stress, and its equivalent plastic strain over
/// that along the wall (E6b).
inline constexpr double kHeldFlow = 2.0 / std::numbers::sqrt3;

/// From the parameters of a material to those of its walls in plane strain (E6b).
void hold_walls(LawParameters& law);

/// Increase of the yield stress over plastic strain, MPa. Empty without a table.
BentLine bent_line_of(const HardeningTable& table);

/// Factor of the yield stress less 1 over the logarithm of the rate, of a table or after Johnson and Cook.
BentLine bent_line_of_rate(const LawParameters& law);

/// Increase of the yield stress at rest, MPa, and its slope (E6d), in the words of theory: the kernels have their own
/// (law/kinds/flow_stress-inl.h).
struct CurvePoint {
  double increase = 0.0;
  double slope = 0.0;
};
CurvePoint curve_point(const LawParameters& law, double plastic_strain);

}  // namespace cellcrush
