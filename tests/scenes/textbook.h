#pragma once

#include <utility>
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
  static double frequency();  ///< 1/s, the first of the cantilever
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

// What the samples of the textbook frames must show, whether a test ran them itself or fetched them from a daemon. Each
// reports through GoogleTest.

/// Moment against curvature of a rectangular bilinear section, exact: with k_e the curvature at yield,
///   M = (1 - E_T / E) M_e (1.5 - 0.5 (k_e / k)^2) + E_T I k;  the unloading slope is EI. Returns the
/// worst relative errors of the moment and of the slope.
std::pair<double, double> expect_moment_curvature_law(const std::vector<Sample>& samples, double peak);

/// Plastic work of the cycles: the same from the second on (returns the worst relative difference); falling toward none
/// (returns that of the last over the largest).
double expect_closed_cycles(const std::vector<Sample>& samples, int cycles);
double expect_shakedown(const std::vector<Sample>& samples, int cycles);

/// Force at the end is factor M_p / L, and it stays there. Returns the force over that.
double expect_limit_load(const std::vector<Sample>& samples, double WatchedNode::*component, double factor);

/// First limit 1.8557 N at a deflection of 48.74 mm. Returns force and deflection.
std::pair<double, double> expect_lee_limit(const std::vector<Sample>& samples);

/// Load over buckling load, and the end angle of the elastica in degrees.
inline constexpr std::pair<double, double> kColumnAngles[] = {{1.01540, 20.0}, {1.15172, 60.0}, {1.39320, 90.0}};
/// Returns the relative error.
double expect_end_angle(const std::vector<Sample>& samples, double degrees);

}  // namespace cellcrush::scenes
