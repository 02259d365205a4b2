#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cellcrush/sample.h"

namespace cellcrush {

/// A stress-strain curve of interval means: constant between the strains of two samples.
class Curve {
 public:
  /// `stress` says which stress of the samples. REQUIRES: strains that do not fall.
  Curve(std::span<const Sample> samples, double Sample::*stress);

  /// Integral of the stress from 0 to a strain; constant stress beyond the last sample counts as none.
  [[nodiscard]] double integral(double strain) const;

  /// Mean stress between two strains, or nothing when the curve ends before `high`.
  [[nodiscard]] std::optional<double> mean(double low, double high) const;

  /// Onset of densification: the strain of the greatest maximum of the energy-absorption efficiency
  ///   eta(eps) = (1 / sigma) integral_0^eps sigma d eps,
  /// sigma smoothed over a window of strain. Nothing while eta has not fallen by 5 % after it.
  static constexpr double kSmoothing = 0.01;
  [[nodiscard]] std::optional<double> densification(double window = kSmoothing) const;

 private:
  std::vector<double> strain_;    // of the samples, with a 0 before them
  std::vector<double> integral_;  // up to strain_
};

}  // namespace cellcrush
