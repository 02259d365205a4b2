#include <algorithm>
#include <cmath>

#include "cellcrush/simulation.h"
#include "measure/curve.h"
#include "measure/theory.h"
#include "measure/warnings.h"

namespace cellcrush {
namespace {

constexpr double kAbsorbedTo = 0.5;

/// Greatest |residual| over the energy turned over by then. It counts once that is a hundredth of the final turnover;
/// before that the ratio compares two small numbers.
double energy_error_of(std::span<const Sample> samples) {
  const double threshold = 0.01 * turnover_of(samples.back());
  double error = 0.0;
  for (const Sample& sample : samples) {
    const double turnover = turnover_of(sample);
    if (turnover > threshold) {
      error = std::max(error, std::abs(sample.energies.residual) / turnover);
    }
  }
  return error;
}

/// Sets the mode that most evaluations found; of equally frequent ones, the first.
void set_crush_mode(std::span<const Sample> samples, Summary& summary) {
  const auto evaluations = [&](CrushMode mode) {
    return std::count_if(samples.begin(), samples.end(),
                         [&](const Sample& sample) { return sample.crush_mode == mode; });
  };
  for (const Sample& sample : samples) {
    if (sample.crush_mode != CrushMode::none &&
        (summary.crush_mode == CrushMode::none || evaluations(sample.crush_mode) > evaluations(summary.crush_mode))) {
      summary.crush_mode = sample.crush_mode;
      summary.crush_mode_strain = sample.strain;
    }
  }
}

/// Difference of the mean stresses at both plates over a range of strain, divided by the mean of both; nothing if there
/// is no stress.
std::optional<double> plate_difference(const Curve& impact, const Curve& support, double low, double high) {
  const auto impact_mean = impact.mean(low, high);
  const auto support_mean = support.mean(low, high);
  if (!impact_mean || !support_mean || *impact_mean + *support_mean <= 0.0) {
    return std::nullopt;
  }
  return 2.0 * std::abs(*impact_mean - *support_mean) / (*impact_mean + *support_mean);
}

double kinetic_share(std::span<const Sample> samples) {
  double share = 0.0;
  for (const Sample& sample : samples) {
    if (sample.strain >= Summary::kQuasiStaticFrom && sample.energies.plastic > sample.energies.elastic) {
      share = std::max(share, sample.energies.kinetic / sample.energies.plastic);
    }
  }
  return share;
}

std::optional<QuasiStatic> find_quasi_static(std::span<const Sample> samples, const Curve& impact,
                                             const Curve& support) {
  constexpr double kRoundOff = 1e-9;
  constexpr double kFrom = Summary::kQuasiStaticFrom;
  constexpr double kWindow = Summary::kQuasiStaticWindow;
  const double end = samples.back().strain;
  const int windows = static_cast<int>((end - kFrom) / kWindow + kRoundOff);
  const auto whole = windows > 0 ? plate_difference(impact, support, kFrom, end) : std::nullopt;
  if (!whole) {
    return std::nullopt;
  }
  QuasiStatic found{*whole, *whole, kinetic_share(samples)};
  for (int i = 0; i < windows; ++i) {
    const auto part = plate_difference(impact, support, kFrom + i * kWindow, kFrom + (i + 1) * kWindow);
    found.plate_difference_greatest = std::max(found.plate_difference_greatest, part.value_or(0.0));
  }
  return found;
}

std::optional<double> relative_error(double theory, const std::optional<double>& measured) {
  return measured && *measured > 0.0 ? std::optional(theory / *measured - 1.0) : std::nullopt;
}

}  // namespace

std::optional<double> Summary::shock_error() const {
  return theory.shock > 0.0 ? relative_error(theory.shock, plateau_stress_impact) : std::nullopt;
}

std::optional<double> Summary::front_shock_error() const {
  return front ? relative_error(front->shock, plateau_stress_impact) : std::nullopt;
}

Summary summarize(const Scene& scene, std::span<const Sample> samples) {
  Summary summary;
  summary.theory = theory_of(scene);
  if (samples.empty()) {
    return summary;
  }
  summary.step_count = samples.back().step;
  summary.deepest_penetration = samples.back().deepest_penetration;
  summary.energy_error_relative = energy_error_of(samples);
  summary.warnings = collect_warnings(samples);
  if (!scene.plates.present) {
    return summary;
  }
  const Curve impact(samples, &Sample::stress_impact);
  const Curve support(samples, &Sample::stress_support);
  summary.plateau_stress_impact = impact.mean(Summary::kPlateauLow, Summary::kPlateauHigh);
  summary.plateau_stress_support = support.mean(Summary::kPlateauLow, Summary::kPlateauHigh);
  if (summary.plateau_stress_support) {
    summary.front = summarize_front(scene, samples, *summary.plateau_stress_support);
  }
  summary.densification_strain = find_densification(curve_of_both_plates(samples));
  if (summary.densification_strain) {
    summary.plateau_stress_to_densification = impact.mean(0.0, *summary.densification_strain);
    summary.solid_fraction_at_densification = relative_density_of(scene) / (1.0 - *summary.densification_strain);
  }
  set_crush_mode(samples, summary);
  summary.quasi_static = find_quasi_static(samples, impact, support);
  const double volume = scene.length * scene.width * scene.depth;
  summary.absorbed_energy = volume * impact.integral(std::min(kAbsorbedTo, samples.back().strain));
  return summary;
}

}  // namespace cellcrush
