#pragma once

#include <optional>
#include <vector>

#include "compare/measurement.h"

namespace cellcrush::compare {

/// What a curve says in numbers. Stresses in MPa or forces in N, over strains or displacements in mm (CurveKind).
struct CurveNumbers {
  std::optional<double> slope;    ///< of the rise to the first peak or the knee, from 20 to 60 % of it
  std::optional<double> peak;     ///< first of half the mean or more, from which the curve falls by 5 %
  std::optional<double> peak_at;  ///< where
  std::optional<double> mean;     ///< over the window; nothing if the curve does not cover it
  double energy = 0.0;            ///< integral up to the end: mJ/mm3 or mJ
};

/// A range of strain or displacement.
struct CurveRange {
  double from = 0.0;
  double to = 0.0;
};

/// What is compared besides the curves.
struct ComparedRanges {
  std::optional<CurveRange> window;  ///< of the mean; nothing: strains of 0.2 to 0.4, as in ISO 13314, or the whole
  std::optional<double> energy_to;   ///< end of the energy; nothing: of the curves
};

/// A computed curve against a measured one, or against the mean of several.
struct CurveDifference {
  CurveKind kind = CurveKind::stress_strain;
  CurveRange common;       ///< that all have
  CurveRange window;       ///< of the mean
  double energy_to = 0.0;  ///< end of the energy
  CurveNumbers measured;
  CurveNumbers computed;
  double greatest = 0.0;      ///< computed minus measured, where that is greatest in size
  double greatest_at = 0.0;   ///< where
  double rms = 0.0;           ///< root of the mean square over the common range
  std::vector<double> x;      ///< evenly over the common range, as the curves below
  std::vector<double> mean;   ///< of the tests
  std::vector<double> least;  ///< of the tests
  std::vector<double> most;   ///< of the tests
  std::vector<double> computed_y;
};

/// Compares over the range that all curves have. Throws InvalidField, if they do not overlap or the energy ends beyond
/// them.
CurveDifference compare_curves(CurveKind kind, const LoadCurve& computed, const std::vector<Measurement>& measured,
                               const ComparedRanges& ranges);

}  // namespace cellcrush::compare
