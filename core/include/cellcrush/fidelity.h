#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/spec_checker.h"

namespace cellcrush {

/// What the crushes of a scene were found to be off by at a point of the chart, over seeds of a tiny imperfection.
/// Relative to the mean of the converged crush.
struct MeasuredError {
  std::string measure;       ///< what of which scene, in words
  double error = 0.0;        ///< of its mean
  double uncertainty = 0.0;  ///< half of its 95 % interval; an error below it is not known to be there
  double scatter = 0.0;      ///< standard deviation of one crush

  /// No error below its uncertainty is claimed.
  [[nodiscard]] double claimed() const { return error > uncertainty ? error : uncertainty; }
};

/// A point of the measured front of speed against accuracy: what it fills in where a spec leaves it out, and what it
/// was measured to be worth with all else as by default.
struct FidelityPoint {
  NumericsSpec::Fidelity fidelity = NumericsSpec::Fidelity::unspecified;
  std::string name;  ///< as cases write it
  int elements_per_wall = 0;
  double step_cost = 1.0;  ///< time of an element-step over that of STANDARD
  std::vector<MeasuredError> errors;
};

/// DRAFT, STANDARD, REFERENCE.
const std::vector<FidelityPoint>& fidelity_points();

/// The spec with what its fidelity fills in where it is left out, or the defaults without one. What is given stays.
SceneSpec fill_in_fidelity(const SceneSpec& spec);

/// What it fills in, a sentence; empty without a fidelity.
std::string describe_fidelity(const SceneSpec& spec);

/// What a spec would take and be worth at a fidelity.
struct FidelityForecast {
  FidelityPoint
      point;  ///< with the elements a wall that the spec then has; nothing measured where `given` is not empty
  std::int64_t step_count = 0;
  std::int64_t element_count = 0;
  std::vector<std::string> given;  ///< fields that the spec gives otherwise than they were measured
};

/// Of every fidelity at which the spec, a lattice between plates, can be built; none for frames, of which nothing was
/// measured. Meshes that the checker knows are not built again.
std::vector<FidelityForecast> forecast_fidelities(const SceneSpec& spec, SpecChecker& checker);

}  // namespace cellcrush
