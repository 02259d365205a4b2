#include "measure/densification.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

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
    const double stress = curve.smoothed(strain);
    plateau.strain.push_back(strain);
    plateau.stress.push_back(stress);
    plateau.mean.push_back((curve.integral(strain) - before) / (strain - kPlateauBegins));
    plateau.greatest.push_back(plateau.greatest.empty() ? stress : std::max(plateau.greatest.back(), stress));
  }
  plateau.least_left = plateau.stress;
  for (std::size_t i = plateau.least_left.size(); i-- > 1;) {
    plateau.least_left[i - 1] = std::min(plateau.least_left[i - 1], plateau.least_left[i]);
  }
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
      const double efficiency =
          plateau.stress[i] > 0.0 ? curve.integral(plateau.strain[i]) / plateau.stress[i] : greatest;
      if (efficiency > greatest) {
        greatest = efficiency;
        onset = i;
      }
    }
    return plateau.strain[onset];
  }
  return std::nullopt;
}

}  // namespace cellcrush
