#pragma once

#include <utility>
#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

// Undamped motions as explicit frames.

/// Parkes's problem: a perfectly plastic cantilever (b 1 mm, h 4 mm, L 100 mm) with a mass at its tip, ten times its
/// own, that is struck across. E / sigma_y = 20000 makes the energy 80 times M_p^2 L / 2 EI, so that little of it is
/// elastic; a tip as light as the cantilever would need far more (what the running hinge bends is then mostly elastic).
/// The tip is watched.
struct StruckCantilever {
  static constexpr double kLength = 100.0;  // mm
  static constexpr double kThickness = 4.0;
  static constexpr double kModulus = 200000.0;  // MPa
  static constexpr double kYieldStress = 10.0;
  static constexpr double kFullMoment = kYieldStress * kThickness * kThickness / 4.0;  // N mm
  static constexpr double kMassPerLength = 7.85e-9 * kThickness;                       // tonne / mm
  static constexpr double kTipMass = 10.0 * kMassPerLength * kLength;                  // tonne
  static constexpr double kSpeed = 630.0;                                              // mm / s

  /// Deflection at rest, mm, and the time to it, s, of the rigid-plastic cantilever (Parkes 1955): a hinge runs from
  /// the tip to the clamp, then the whole turns about it.
  static double final_deflection();
  static double duration();

  /// The tip's node bears the struck mass, of which half an element is the cantilever's.
  static SceneSpec spec(int elements, double end_time);
};

/// A bar of half length L that spins about its middle, unstretched at first; its ends are watched.
struct SpinningBar {
  static constexpr double kHalfLength = 100.0;  // mm
  static constexpr double kThickness = 2.0;
  static constexpr double kStretch = 1e-4;  ///< rho omega^2 L^2 / 3 E: steady tip displacement over L
  static double wave_speed();               ///< mm / s
  static double spin();                     ///< omega, rad / s
  static double axial_period();             ///< s, of the slowest stretching

  /// `elements` in half the bar, for `periods` axial periods.
  static SceneSpec spec(int elements, double periods);
};

/// An elastic cantilever on whose tip a load is put at time 0 and stays; the tip is watched.
struct StepLoadedCantilever {
  double length = 300.0;  // mm
  double thickness = 1.0;
  double modulus = 200000.0;  // MPa
  double density_kg_per_m3 = 7850.0;
  double static_deflection = 0.1;  // mm, that the load P has when it rests

  [[nodiscard]] double first_period() const;  ///< s
  /// Tip deflection in mm at a time, by the modes of a slender beam.
  [[nodiscard]] double deflection_at(double time) const;
  /// `steps` of equal length to the end; 0: the chosen step.
  [[nodiscard]] SceneSpec spec(int elements, double end_time, int steps) const;
};

// What the samples of the dynamic frames must show, whether a test ran them itself or fetched them from a daemon. Each
// reports through GoogleTest.

/// Where the watched node of a struck plastic frame comes to rest: the time of its first maximum, and the mean of the
/// elastic vibration after it, weighted by 1 - cos.
struct Rest {
  double time = 0.0;        // s
  double deflection = 0.0;  // mm
};
Rest rest_of(const std::vector<Sample>& samples);

/// The struck cantilever comes to rest, but for elastic vibration, within 2 % of Parkes's deflection and 3 % of his
/// time; the plastic work is the energy it was struck with but for what vibrates on, within 1 %. Returns deflection and
/// time over his.
std::pair<double, double> expect_parkes(const std::vector<Sample>& samples);

/// The spinning bar's mean stretch is rho omega^2 L^3 / 3 E, that of its lumped masses within 0.1 %, and its energy is
/// kept: it swings with the explicit steps by a millionth and does not drift. Returns stretch over that of the lumped
/// masses, and the relative drift of the energy.
std::pair<double, double> expect_steady_stretch(const std::vector<Sample>& samples, int elements);

/// Returns the greatest deflection of the step-loaded cantilever over that at rest: within a hundredth of the modes'
/// sum.
double expect_dynamic_factor(const std::vector<Sample>& samples, const StepLoadedCantilever& cantilever);

}  // namespace cellcrush::scenes
