#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/spec_checker.h"

namespace cellcrush {

/// Error that the mesh leaves in one quantity, measured over seeds of a small imperfection. Relative to the mean of the
/// finest mesh that was measured.
struct MeasuredError {
  std::string measure;       ///< the quantity, the preset and the speeds, in words
  double error = 0.0;        ///< of the mean; of the finest mesh itself: its difference from the next coarser one
  double uncertainty = 0.0;  ///< half of the 95 % confidence interval of the error; a smaller error is not significant
  double scatter = 0.0;      ///< standard deviation of one crush

  /// The error, but at least its uncertainty.
  [[nodiscard]] double claimed() const { return error > uncertainty ? error : uncertainty; }
};

/// A trade-off between speed and accuracy: the settings that it fills in where a spec omits them.
struct FidelityPoint {
  NumericsSpec::Fidelity fidelity = NumericsSpec::Fidelity::unspecified;
  std::string name;  ///< as written in a case
  int elements_per_wall = 0;
};

/// DRAFT, STANDARD, REFERENCE for the lattice and the elements of a spec.
std::vector<FidelityPoint> fidelity_points(const SceneSpec& spec);

/// Time per element-step with this mesh, relative to 2 elements per wall.
double step_cost_of(int elements_per_wall);

/// The spec with the settings of its fidelity, or the defaults if it names none, filled in where it omits them. Given
/// settings are kept.
SceneSpec fill_in_fidelity(const SceneSpec& spec);

/// Which mesh a spec gets and why, as a sentence; empty for a frame.
std::string describe_fidelity(const SceneSpec& spec);

/// Predicted cost and accuracy of a spec at a fidelity.
struct FidelityForecast {
  FidelityPoint point;  ///< with the elements per wall that the spec would have
  std::int64_t step_count = 0;
  std::int64_t element_count = 0;
  std::vector<MeasuredError> errors;  ///< empty if none was measured with this mesh, or if `given` is not empty
  std::vector<std::string> given;     ///< fields in which the spec differs from everything that was measured
};

/// Forecasts for every fidelity at which the spec, a lattice between plates, can be built. None for frames, for which
/// nothing was measured. Meshes that the checker knows are not rebuilt.
std::vector<FidelityForecast> forecast_fidelities(const SceneSpec& spec, SpecChecker& checker);

}  // namespace cellcrush
