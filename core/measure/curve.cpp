#include "measure/curve.h"

#include <algorithm>

namespace cellcrush {

Curve::Curve(std::span<const Sample> samples, double Sample::*stress) : strain_{0.0}, integral_{0.0} {
  for (const Sample& sample : samples) {
    const double width = sample.strain - strain_.back();
    if (width > 0.0) {
      integral_.push_back(integral_.back() + sample.*stress * width);
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

std::optional<double> Curve::densification(double window) const {
  const double half = 0.5 * window;
  constexpr double kFall = 0.95;
  double greatest = 0.0;
  double onset = 0.0;
  double newest = 0.0;
  for (const double strain : strain_) {
    if (strain < half || strain > strain_.back() - half) {
      continue;
    }
    const double smooth = (integral(strain + half) - integral(strain - half)) / (2.0 * half);
    if (smooth <= 0.0) {
      continue;
    }
    newest = integral(strain) / smooth;
    if (newest > greatest) {
      greatest = newest;
      onset = strain;
    }
  }
  return greatest > 0.0 && newest < kFall * greatest ? std::optional(onset) : std::nullopt;
}

}  // namespace cellcrush
