#pragma once

#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// One slanted wall of the hexagons of Papka and Kyriakides, dimensions 1: at 30 degrees, lower joint clamped, upper
/// joint pushed straight down, its rotation fixed, free sideways. All of a lattice that collapses evenly is made of
/// such walls, so its load F and way d are the lattice's nominal stress F / (L cos 30 b) and strain d / (1.5 L).
/// Quasi-static by a slow motion under mass damping; the upper joint is watched.
struct CrushedWall {
  static constexpr double kLength = 5.51;       // mm
  static constexpr double kThickness = 0.1448;  // mm
  static constexpr double kModulus = 69000.0;   // MPa
  static constexpr double kTangent = 690.0;     // E_T, MPa
  static constexpr double kYieldStress = 292.0;
  static constexpr double kEndStrain = 0.135;

  static SceneSpec spec(int elements, const SectionSpec& section);

  /// Nominal stress in MPa at a strain, the slope of the work over 0.002 of strain.
  static double stress_at(const std::vector<Sample>& samples, double strain);
};

}  // namespace cellcrush::scenes
