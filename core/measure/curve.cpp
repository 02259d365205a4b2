#include "measure/curve.h"

#include <algorithm>

namespace cellcrush {

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

}  // namespace cellcrush
