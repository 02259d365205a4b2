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
  /// `stress` of a sample, MPa. REQUIRES: strains that do not fall.
  Curve(std::span<const Sample> samples, const std::function<double(const Sample&)>& stress);

  /// Strain of the last sample.
  [[nodiscard]] double end() const { return strain_.back(); }

  /// Integral of the stress from 0 to a strain; constant stress beyond the last sample counts as none.
  [[nodiscard]] double integral(double strain) const;

  /// Mean stress between two strains, or nothing when the curve ends before `high`.
  [[nodiscard]] std::optional<double> mean(double low, double high) const;

  /// Mean stress over a window of strain about a strain. The curve shows single collapses of cells at less than
  /// kSmoothing.
  static constexpr double kSmoothing = 0.01;
  [[nodiscard]] double smoothed(double strain, double window = kSmoothing) const;

 private:
  std::vector<double> strain_;    // of the samples, with a 0 before them
  std::vector<double> integral_;  // up to strain_
};

/// The mean of both plates' stresses. It rises once the front of a fast crush arrives at the support plate, of which
/// the stress at the impact plate alone shows little, and is the stress of either plate in a slow crush.
Curve curve_of_both_plates(std::span<const Sample> samples);

}  // namespace cellcrush
