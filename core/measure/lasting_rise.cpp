#include "measure/lasting_rise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "scene/solid_area.h"

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

/// Greatest fall of the stress below its greatest value before, over that, up to a point.
double greatest_fall(const Plateau& plateau, std::size_t end) {
  double fall = 0.0;
  for (std::size_t i = 0; i < end; ++i) {
    if (plateau.greatest[i] > 0.0) {
      fall = std::max(fall, 1.0 - plateau.stress[i] / plateau.greatest[i]);
    }
  }
  return fall;
}

/// Whether the stress rises at a point to stay.
bool rises_at(const Plateau& plateau, std::size_t i) {
  return plateau.strain[i] >= kLeastRise && plateau.strain.back() - plateau.strain[i] >= kLasts &&
         plateau.mean[i] > 0.0 && plateau.least_left[i] >= kRise * plateau.mean[i] &&
         plateau.least_left[i] >= kAbovePeaks * plateau.greatest[find_foot(plateau, i)];
}

/// Strain of the greatest efficiency between two points.
double find_greatest_efficiency(const Curve& curve, const Plateau& plateau, std::size_t first, std::size_t last) {
  std::size_t onset = first;
  double greatest = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const double efficiency = curve.integral(plateau.strain[i]) / plateau.stress[i];
    if (plateau.stress[i] > 0.0 && efficiency > greatest) {
      greatest = efficiency;
      onset = i;
    }
  }
  return plateau.strain[onset];
}

/// Whether the lattice is dense at a strain, by the last sample up to it. A frame without cells has no densest layer.
bool is_dense_at(const Scene& scene, std::span<const Sample> samples, double strain) {
  const auto after = std::ranges::upper_bound(samples, strain, {}, &Sample::strain);
  if (after == samples.begin()) {
    return false;
  }
  const Sample& sample = *(after - 1);
  const double layer = sample.densest_layer.solid_fraction;
  const auto walls = static_cast<double>(scene.walls.start.size());
  return solid_fraction_at(scene, strain) >= kDenseLattice && (layer <= 0.0 || layer >= kDenseLayer) &&
         static_cast<double>(sample.contact_count) >= kDenseContacts * walls;
}

bool hardens(const Scene& scene) {
  return std::ranges::any_of(scene.materials, [](const Material& material) { return material.law.hardens(); });
}

RiseKind kind_of(const Scene& scene, const CurveRise& rise) {
  if (rise.is_dense) return RiseKind::densification;
  if (rise.has_fallen) return RiseKind::second_collapse;
  return hardens(scene) ? RiseKind::hardening : RiseKind::stiffening;
}

}  // namespace

std::optional<CurveRise> find_rise(const Curve& curve, const std::function<bool(double)>& is_dense) {
  const Plateau plateau = find_plateau(curve);
  std::optional<CurveRise> thin;
  for (std::size_t rise = 0; rise < plateau.strain.size(); ++rise) {
    if (!rises_at(plateau, rise)) {
      continue;
    }
    const std::size_t foot = find_foot(plateau, rise);
    std::size_t first = rise + 1;  // from which the lattice is dense up to `rise`
    while (first > foot && is_dense(plateau.strain[first - 1])) {
      --first;
    }
    if (first <= rise) {
      return CurveRise{find_greatest_efficiency(curve, plateau, first, rise), true, false};
    }
    if (!thin) {
      thin = {find_greatest_efficiency(curve, plateau, foot, rise), false, greatest_fall(plateau, rise) >= kCollapsed};
    }
  }
  return thin;
}

std::optional<double> find_onset(const Curve& curve) {
  const auto rise = find_rise(curve, [](double) { return true; });
  return rise ? std::optional(rise->onset) : std::nullopt;
}

std::optional<LastingRise> find_lasting_rise(const Scene& scene, std::span<const Sample> samples) {
  const auto rise = find_rise(curve_of_both_plates(samples),
                              [&](double strain) { return is_dense_at(scene, samples, strain); });
  return rise ? std::optional(LastingRise{kind_of(scene, *rise), rise->onset}) : std::nullopt;
}

}  // namespace cellcrush
