#include "measure/curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace cellcrush {
namespace {

constexpr double kPlateauBegins = 0.2;
constexpr double kLeastRise = 0.3;
constexpr double kRise = 1.3;
constexpr double kAbovePeaks = 1.15;
constexpr double kLasts = 0.01;
constexpr double kStep = 0.001;  // strain, for any sampling

/// The smoothed curve from kPlateauBegins on.
struct Plateau {
  std::vector<double> strain;
  std::vector<double> stress;
  std::vector<double> mean;        ///< mean stress since kPlateauBegins
  std::vector<double> greatest;    ///< greatest stress up to here
  std::vector<double> least_left;  ///< least stress from here to the end
};

Plateau find_plateau(const Curve& curve) {
  Plateau plateau;
  const double before = curve.integral(kPlateauBegins);
  const double last = curve.end() - 0.5 * Curve::kSmoothing;
  const auto count = static_cast<int>(std::floor((last - kPlateauBegins) / kStep));
  for (int i = 1; i <= count; ++i) {
    const double strain = kPlateauBegins + kStep * i;
    plateau.strain.push_back(strain);
    plateau.stress.push_back(curve.smoothed(strain));
    plateau.mean.push_back((curve.integral(strain) - before) / (strain - kPlateauBegins));
  }
  plateau.greatest = plateau.least_left = plateau.stress;
  std::partial_sum(plateau.stress.begin(), plateau.stress.end(), plateau.greatest.begin(),
                   [](double a, double b) { return std::max(a, b); });
  std::partial_sum(plateau.stress.rbegin(), plateau.stress.rend(), plateau.least_left.rbegin(),
                   [](double a, double b) { return std::min(a, b); });
  return plateau;
}

/// Index of the last point before `rise` at which the stress is not above the mean of the plateau; 0 if there is none.
std::size_t find_foot(const Plateau& plateau, std::size_t rise) {
  std::size_t foot = rise;
  while (foot > 0 && plateau.stress[foot] > plateau.mean[rise]) {
    --foot;
  }
  return foot;
}

}  // namespace

Curve::Curve(std::span<const Sample> samples, const std::function<double(const Sample&)>& stress)
    : strain_{0.0}, integral_{0.0} {
  for (const Sample& sample : samples) {
    const double width = sample.strain - strain_.back();
    if (width > 0.0) {
      integral_.push_back(integral_.back() + stress(sample) * width);
      strain_.push_back(sample.strain);
    }
  }
}

double Curve::integral(double strain) const {
  if (strain <= 0.0) {
    return 0.0;
  }
  if (strain >= strain_.back()) {
    return integral_.back();
  }
  const auto after = std::upper_bound(strain_.begin(), strain_.end(), strain) - strain_.begin();
  const double share = (strain - strain_[after - 1]) / (strain_[after] - strain_[after - 1]);
  return integral_[after - 1] + share * (integral_[after] - integral_[after - 1]);
}

std::optional<double> Curve::mean(double low, double high) const {
  constexpr double kRoundOff = 1e-9;
  if (strain_.back() < high - kRoundOff) {
    return std::nullopt;
  }
  return (integral(high) - integral(low)) / (high - low);
}

double Curve::smoothed(double strain, double window) const {
  return (integral(strain + 0.5 * window) - integral(strain - 0.5 * window)) / window;
}

Curve curve_of_both_plates(std::span<const Sample> samples) {
  return {samples, [](const Sample& sample) { return 0.5 * (sample.stress_impact + sample.stress_support); }};
}

std::optional<double> find_densification(const Curve& curve) {
  const Plateau plateau = find_plateau(curve);
  for (std::size_t rise = 0; rise < plateau.strain.size(); ++rise) {
    if (plateau.strain[rise] < kLeastRise || plateau.strain.back() - plateau.strain[rise] < kLasts ||
        plateau.mean[rise] <= 0.0 || plateau.least_left[rise] < kRise * plateau.mean[rise]) {
      continue;
    }
    const std::size_t foot = find_foot(plateau, rise);
    if (plateau.least_left[rise] < kAbovePeaks * plateau.greatest[foot]) {
      continue;
    }
    std::size_t onset = foot;
    double greatest = 0.0;
    for (std::size_t i = foot; i <= rise; ++i) {
      const double efficiency = curve.integral(plateau.strain[i]) / plateau.stress[i];
      if (plateau.stress[i] > 0.0 && efficiency > greatest) {
        greatest = efficiency;
        onset = i;
      }
    }
    return plateau.strain[onset];
  }
  return std::nullopt;
}

}  // namespace cellcrush
