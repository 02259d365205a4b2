#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/spec_checker.h"

namespace cellcrush {

/// Error of a crush at a fidelity point, measured over seeds of a tiny imperfection. Relative to the mean of the
/// converged crush.
struct MeasuredError {
  std::string measure;       ///< the quantity and the scene, in words
  double error = 0.0;        ///< error of the mean
  double uncertainty = 0.0;  ///< half of the 95 % confidence interval of the error; a smaller error is not significant
  double scatter = 0.0;      ///< standard deviation of one crush

  /// The error, but at least its uncertainty.
  [[nodiscard]] double claimed() const { return error > uncertainty ? error : uncertainty; }
};

/// A point of the measured speed-accuracy front: the settings that it fills in where a spec omits them, and its errors.
/// These were measured with all other settings at their defaults.
struct FidelityPoint {
  NumericsSpec::Fidelity fidelity = NumericsSpec::Fidelity::unspecified;
  std::string name;  ///< as written in a case
  int elements_per_wall = 0;
  double step_cost = 1.0;  ///< time per element-step relative to STANDARD
  std::vector<MeasuredError> errors;
};

/// DRAFT, STANDARD, REFERENCE.
const std::vector<FidelityPoint>& fidelity_points();

/// The spec with the settings of its fidelity, or the defaults if it names none, filled in where it omits them. Given
/// settings are kept.
SceneSpec fill_in_fidelity(const SceneSpec& spec);

/// What the fidelity fills in, as a sentence; empty without a fidelity.
std::string describe_fidelity(const SceneSpec& spec);

/// Predicted cost and accuracy of a spec at a fidelity.
struct FidelityForecast {
  /// With the elements per wall that the spec would have; without measured errors if `given` is not empty.
  FidelityPoint point;
  std::int64_t step_count = 0;
  std::int64_t element_count = 0;
  std::vector<std::string> given;  ///< fields that the spec sets to other values than the measurement
};

/// Forecasts for every fidelity at which the spec, a lattice between plates, can be built. None for frames, for which
/// nothing was measured. Meshes that the checker knows are not rebuilt.
std::vector<FidelityForecast> forecast_fidelities(const SceneSpec& spec, SpecChecker& checker);

}  // namespace cellcrush
