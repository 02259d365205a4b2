#pragma once

#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// A perfectly plastic portal frame, clamped below (all members L 100, h 4, b 1 mm; E / sigma_y = 10000, so that it
/// collapses before it has changed its shape), with a dead load on one place and another moved until it collapses: H on
/// the left corner to the right, V on the middle of the beam downward. The moved node is watched first, the loaded one
/// second.
struct PortalFrame {
  static constexpr double kLength = 100.0;  // mm, of every member
  static constexpr double kThickness = 4.0;
  static constexpr double kModulus = 200000.0;  // MPa
  static constexpr double kYieldStress = 20.0;
  static constexpr double kFullMoment = kYieldStress * kThickness * kThickness / 4.0;  // M_p, N mm

  /// By which joints it collapses: both columns' ends; the beam's; the beam's middle, its right end and both feet.
  enum class Mechanism { sway, beam, combined };

  /// Left corner moved by `sway` mm under V = vertical_load (in M_p / L); middle of the beam moved by `sag` mm under
  /// H = horizontal_load.
  static SceneSpec swayed(double vertical_load, double sway, int elements);
  static SceneSpec sagged(double horizontal_load, double sag, int elements);
};

/// Load on the moved node over what plastic theory has for the mechanism at the node's displacement, all dead loads'
/// work included: virtual work gives, with theta the columns' or the beam's turn,
///   sway      H L cos theta + V L sin theta = 4 M_p
///   combined  H L cos theta + V L (sin theta + cos theta / 2) = 6 M_p
///   beam      V L cos theta / 2 = 4 M_p.
/// It is 1 within a hundredth over the last fifth of the way. Returns it.
double expect_portal_collapse(const std::vector<Sample>& samples, PortalFrame::Mechanism mechanism, double dead_load);

}  // namespace cellcrush::scenes
