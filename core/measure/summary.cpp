#include <algorithm>
#include <cmath>

#include "cellcrush/simulation.h"
#include "measure/curve.h"
#include "measure/theory.h"

namespace cellcrush {
namespace {

constexpr double kAbsorbedTo = 0.5;

/// Greatest |residual| over the external work done by then, once a hundredth of the final work is done: before that the ratio
/// compares two small numbers.
double energy_error_of(std::span<const Sample> samples) {
  const double threshold = 0.01 * std::abs(samples.back().work_external);
  double error = 0.0;
  for (const Sample& sample : samples) {
    const double work = std::abs(sample.work_external);
    if (work > threshold) {
      error = std::max(error, std::abs(sample.energy_residual) / work);
    }
  }
  return error;
}

}  // namespace

Summary summarize(const Scene& scene, std::span<const Sample> samples) {
  Summary summary;
  summary.theory = theory_of(scene);
  if (samples.empty()) {
    return summary;
  }
  summary.step_count = samples.back().step;
  summary.deepest_penetration = samples.back().deepest_penetration;
  summary.energy_error_relative = energy_error_of(samples);
  if (!scene.plates.present) {
    return summary;
  }
  const Curve impact(samples, &Sample::stress_impact);
  const Curve support(samples, &Sample::stress_support);
  summary.plateau_stress_impact = impact.mean(Summary::kPlateauLow, Summary::kPlateauHigh);
  summary.plateau_stress_support = support.mean(Summary::kPlateauLow, Summary::kPlateauHigh);
  summary.densification_strain = impact.densification();
  if (summary.densification_strain) {
    summary.plateau_stress_to_densification = impact.mean(0.0, *summary.densification_strain);
  }
  const double volume = scene.length * scene.width * scene.depth;
  summary.absorbed_energy = volume * impact.integral(std::min(kAbsorbedTo, samples.back().strain));
  return summary;
}

}  // namespace cellcrush
