#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "cellcrush/sample.h"

namespace cellcrush {

/// A stress-strain curve of interval means: constant between the strains of two samples.
class Curve {
 public:
  /// `stress` gives the stress of a sample, MPa. REQUIRES: strains that do not decrease.
  Curve(std::span<const Sample> samples, const std::function<double(const Sample&)>& stress);

  /// Strain of the last sample.
  [[nodiscard]] double end() const { return strain_.back(); }

  /// Integral of the stress from 0 to a strain; beyond the last sample the stress counts as 0.
  [[nodiscard]] double integral(double strain) const;

  /// Mean stress between two strains; nothing if the curve ends before `high`.
  [[nodiscard]] std::optional<double> mean(double low, double high) const;

  /// Mean stress over a window of strain centred on a strain. With windows smaller than kSmoothing, the curve shows the
  /// collapse of single cells.
  static constexpr double kSmoothing = 0.01;
  [[nodiscard]] double smoothed(double strain, double window = kSmoothing) const;

 private:
  std::vector<double> strain_;    // of the samples, after a 0
  std::vector<double> integral_;  // up to strain_
};

/// The mean of the stresses at both plates. In a fast crush it rises when the front arrives at the support plate; the
/// stress at the impact plate alone shows little of that. In a slow crush it is the stress at either plate.
Curve curve_of_both_plates(std::span<const Sample> samples);

}  // namespace cellcrush
