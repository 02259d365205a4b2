#include "measure/theory.h"

#include <vector>

namespace cellcrush {
namespace {

template <class Value>
double mean_of(const std::vector<const Sample*>& samples, const Value& value) {
  double sum = 0.0;
  for (const Sample* sample : samples) {
    sum += value(*sample);
  }
  return sum / static_cast<double>(samples.size());
}

/// Least-squares slope of the velocity ahead over time, mm/s^2; 0 for a single sample.
double acceleration_ahead(const std::vector<const Sample*>& samples, double mean_velocity) {
  const double time = mean_of(samples, [](const Sample& sample) { return sample.time; });
  double product = 0.0;
  double squares = 0.0;
  for (const Sample* sample : samples) {
    product += (sample->time - time) * (sample->front->velocity_ahead - mean_velocity);
    squares += (sample->time - time) * (sample->time - time);
  }
  return squares > 0.0 ? product / squares : 0.0;
}

}  // namespace

double relative_density_of(const Scene& scene) {
  const double envelope = scene.length * scene.width * scene.depth;
  return envelope > 0.0 ? scene.total_mass / (scene.materials.front().density * envelope) : 0.0;
}

Theory theory_of(const Scene& scene) {
  if (!scene.plates.present) {
    return {};
  }
  Theory theory;
  const double relative_density = relative_density_of(scene);
  theory.gibson_ashby = scene.collapse_stress;
  theory.densification_strain = 1.0 - 1.4 * relative_density;
  const double density = scene.materials.front().density * relative_density;
  if (theory.gibson_ashby > 0.0) {  // known of regular lattices only
    theory.shock =
        theory.gibson_ashby + density * scene.plates.speed * scene.plates.speed / theory.densification_strain;
  }
  return theory;
}

std::optional<FrontSummary> summarize_front(const Scene& scene, std::span<const Sample> samples,
                                            double stress_support) {
  std::vector<const Sample*> fronts;
  std::size_t in_window = 0;
  for (const Sample& sample : samples) {
    if (sample.strain < Summary::kPlateauLow || sample.strain > Summary::kPlateauHigh) {
      continue;
    }
    ++in_window;
    if (sample.front) {
      fronts.push_back(&sample);
    }
  }
  if (fronts.empty() || 2 * fronts.size() < in_window) {
    return std::nullopt;
  }
  FrontSummary summary;
  for (double Front::*const value :
       {&Front::position, &Front::strain_behind, &Front::strain_ahead, &Front::velocity_behind, &Front::velocity_ahead,
        &Front::solid_fraction_behind, &Front::wall_fraction_behind}) {
    summary.*value = mean_of(fronts, [value](const Sample& sample) { return (*sample.front).*value; });
  }
  summary.window_share = static_cast<double>(fronts.size()) / static_cast<double>(in_window);
  const double density = scene.total_mass / (scene.length * scene.width * scene.depth);
  const double length_ahead = scene.length - summary.position;
  summary.stress_ahead = stress_support + density * length_ahead * acceleration_ahead(fronts, summary.velocity_ahead);
  const double velocity_jump = summary.velocity_behind - summary.velocity_ahead;
  summary.shock =
      summary.stress_ahead + density * velocity_jump * velocity_jump / (summary.strain_behind - summary.strain_ahead);
  return summary;
}

}  // namespace cellcrush
