#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/measurement.h"

namespace cellcrush::client {

/// What a curve says in numbers, between two strains.
struct CurveNumbers {
  std::optional<double> slope_mpa;    ///< of the rise to the first peak, from 20 to 60 % of it
  std::optional<double> peak_mpa;     ///< first of half the mean stress or more, from which it falls by 5 %
  std::optional<double> peak_strain;  ///< of that peak
  std::optional<double> mean_mpa;     ///< over the window; nothing if the curve does not cover it
  double energy_mj_per_mm3 = 0.0;     ///< integral of the stress up to the end
};

/// A range of strain.
struct StrainRange {
  double from = 0.0;
  double to = 0.0;
};

/// A computed curve against a measured one, or against the mean of several.
struct CurveDifference {
  StrainRange common;  ///< strain that all have
  StrainRange window;  ///< of the mean
  CurveNumbers measured;
  CurveNumbers computed;
  double greatest_mpa = 0.0;      ///< computed minus measured, where that is greatest in size
  double greatest_strain = 0.0;   ///< where
  double rms_mpa = 0.0;           ///< root of the mean square over the common strain
  std::vector<double> strain;     ///< of the band
  std::vector<double> mean_mpa;   ///< of the tests
  std::vector<double> least_mpa;  ///< of the tests
  std::vector<double> most_mpa;
};

/// Compares over the strain that all curves have. `window`: of the mean; nothing: 0.2 to 0.4, as in ISO 13314. Throws
/// CommandError (refused), if their strains do not overlap.
CurveDifference compare_curves(const StressCurve& computed, const std::vector<Measurement>& measured,
                               const std::optional<StrainRange>& window);

/// The same as lines of a table: quantity, unit, measured, computed, difference.
std::string difference_table(const CurveDifference& difference, const std::vector<Measurement>& measured);

/// The same as one JSON object.
std::string difference_json(const std::string& job, const CurveDifference& difference,
                            const std::vector<Measurement>& measured);

}  // namespace cellcrush::client
