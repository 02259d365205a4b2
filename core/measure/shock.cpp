#include "measure/shock.h"

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

double mean_of(const std::vector<const Sample*>& samples, double Front::*value) {
  return mean_of(samples, [&](const Sample& sample) { return (*sample.front).*value; });
}

/// Least-squares slope of the velocity ahead over time, mm/s^2; 0 for a single sample.
double acceleration_ahead(const std::vector<const Sample*>& samples) {
  const double time = mean_of(samples, [](const Sample& sample) { return sample.time; });
  const double velocity = mean_of(samples, &Front::velocity_ahead);
  double product = 0.0;
  double squares = 0.0;
  for (const Sample* sample : samples) {
    product += (sample->time - time) * (sample->front->velocity_ahead - velocity);
    squares += (sample->time - time) * (sample->time - time);
  }
  return squares > 0.0 ? product / squares : 0.0;
}

}  // namespace

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
  summary.strain_behind = mean_of(fronts, &Front::strain_behind);
  summary.strain_ahead = mean_of(fronts, &Front::strain_ahead);
  summary.velocity_behind = mean_of(fronts, &Front::velocity_behind);
  summary.velocity_ahead = mean_of(fronts, &Front::velocity_ahead);
  summary.solid_fraction_behind = mean_of(fronts, &Front::solid_fraction_behind);
  summary.wall_fraction_behind = mean_of(fronts, &Front::wall_fraction_behind);
  summary.window_share = static_cast<double>(fronts.size()) / static_cast<double>(in_window);
  const double density = scene.total_mass / (scene.length * scene.width * scene.depth);
  const double length_ahead = scene.length - mean_of(fronts, &Front::position);
  summary.stress_ahead = stress_support + density * length_ahead * acceleration_ahead(fronts);
  const double velocity_jump = summary.velocity_behind - summary.velocity_ahead;
  summary.shock =
      summary.stress_ahead + density * velocity_jump * velocity_jump / (summary.strain_behind - summary.strain_ahead);
  return summary;
}

}  // namespace cellcrush
