#pragma once

#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

// Textbook problems as explicit frames: what a user may submit, and what tests hold against closed forms. Every frame
// watches the node that is loaded; motions and loads rise slowly under mass damping, so that the way is quasi-static.

/// Section and material of the plastic frames: b 1 mm, h 4 mm, E 200 GPa, yield stress 200 MPa.
struct PlasticFrame {
  static constexpr double kLength = 100.0;  // mm, of every member
  static constexpr double kThickness = 4.0;
  static constexpr double kModulus = 200000.0;
  static constexpr double kYieldStress = 200.0;
  static constexpr double kFullMoment = kYieldStress * kThickness * kThickness / 4.0;  // N mm
  static constexpr double kYieldMoment = kYieldStress * kThickness * kThickness / 6.0;
  static constexpr double kStiffness = kModulus * kThickness * kThickness * kThickness / 12.0;  // EI, N mm^2
};

/// A cantilever bent by an end moment that rises to `peak` times the yield moment and falls back to 0; E_T = E / 100.
SceneSpec bent_cantilever(double peak);

/// A cantilever whose tip is moved across by `deflection`; a beam clamped at both ends, free to shorten, whose middle
/// is; a portal frame, clamped below, whose left corner is moved sideways. Perfectly plastic, `elements` a member.
SceneSpec pushed_cantilever(double deflection, int elements);
SceneSpec pushed_clamped_beam(double deflection, int elements);
SceneSpec pushed_portal(double sway, int elements);

/// A bar that is stretched to +strain and -strain in turn, `cycles` times, with H = E / 10 and the given isotropic
/// fraction.
SceneSpec cycled_bar(double isotropic_fraction, double strain, int cycles);

/// Lee's frame: two legs of 120 mm (A 6 mm^2, I 2 mm^4, E 720 MPa), pinned at both ends, pushed down by `deflection` 24
/// mm from the corner.
SceneSpec lee_frame(double deflection);

/// An elastic cantilever of 300 mm under an axial dead load of `load_ratio` times its buckling load, nudged aside for a
/// moment.
SceneSpec buckled_column(double load_ratio);

/// Force that moved the watched node along its motion, from the external work between two samples, and where the node
/// was between them.
struct ForceAt {
  double displacement;  // mm
  double force;         // N
};
std::vector<ForceAt> force_curve(const std::vector<Sample>& samples, double WatchedNode::*component);

}  // namespace cellcrush::scenes
