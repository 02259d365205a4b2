#include "beam/section_curvatures.h"

#include <algorithm>
#include <cmath>

namespace cellcrush {
namespace {

/// Rotation over moment of the element, a symmetric 2 x 2 matrix, and the rotations that its unbalance asks for.
struct Flexibility {
  double start = 0.0;
  double mixed = 0.0;
  double end = 0.0;
  double unbalance_start = 0.0;
  double unbalance_end = 0.0;

  /// End moments that turn the ends by the given rotations.
  [[nodiscard]] EndMoments moments_for(double bend_start, double bend_end) const {
    const double a = bend_start - unbalance_start;
    const double b = bend_end - unbalance_end;
    const double inverse = 1.0 / (start * end - mixed * mixed);
    return {inverse * (end * a - mixed * b), inverse * (start * b - mixed * a)};
  }
};

}  // namespace

PerSection balanced_curvatures(const SectionRule& rule, const Material& material, const EndMoments& moments,
                               SectionMemory memory, double bend_start, double bend_end) {
  const std::size_t count = rule.section_count();
  const double elastic = 12.0 / material.youngs_modulus;  // h times curvature, over moment by b h^2
  const double round_off = kSectionRoundOff * material.youngs_modulus;
  PerSection curvature;
  for (bool turned_back = true; turned_back;) {
    Flexibility flexibility;
    for (std::size_t i = 0; i < count; ++i) {
      const double s = rule.along[static_cast<Eigen::Index>(i)];
      const double weighted = rule.along_weight[static_cast<Eigen::Index>(i)] * elastic / memory.tangent_of(i);
      flexibility.start += weighted * (1.0 - s) * (1.0 - s);
      flexibility.mixed -= weighted * (1.0 - s) * s;
      flexibility.end += weighted * s * s;
      flexibility.unbalance_start += weighted * (1.0 - s) * memory.unbalance_of(i);
      flexibility.unbalance_end -= weighted * s * memory.unbalance_of(i);
    }
    const EndMoments increment = flexibility.moments_for(bend_start, bend_end);
    turned_back = false;
    for (std::size_t i = 0; i < count; ++i) {
      const double s = rule.along[static_cast<Eigen::Index>(i)];
      curvature[i] = elastic / memory.tangent_of(i) * (increment.at(s) + memory.unbalance_of(i));
      const double moment = moments.at(s) - memory.unbalance_of(i);
      if (memory.tangent_of(i) < 1.0 && std::abs(moment) > round_off && curvature[i] * moment < 0.0) {
        memory.tangent_of(i) = 1.0;
        turned_back = true;
      }
    }
  }
  return curvature;
}

PerSection moments_of_sections(const SectionRule& rule, const EndMoments& moments, SectionMemory memory) {
  PerSection moment;
  for (std::size_t i = 0; i < rule.section_count(); ++i) {
    moment[i] = moments.at(rule.along[static_cast<Eigen::Index>(i)]) - memory.unbalance_of(i);
  }
  return moment;
}

bool remember_sections(const SectionRule& rule, const Material& material, const PerSection& before,
                       const ElementSums& now, const PerSection& curvature, SectionMemory memory) {
  const double youngs_modulus = material.youngs_modulus;
  double worst = 0.0;
  for (std::size_t i = 0; i < rule.section_count(); ++i) {
    const double s = rule.along[static_cast<Eigen::Index>(i)];
    const double elastic_increment = youngs_modulus / 12.0 * curvature[i];
    if (std::abs(elastic_increment) > kSectionRoundOff * youngs_modulus) {
      const double tangent = (now.moment[i] - before[i]) / elastic_increment;
      memory.tangent_of(i) = tangent > 1.0 - 1e-6 ? 1.0 : std::max(tangent, kLeastTangent);
    }
    const double unbalance = now.moments.at(s) - now.moment[i];
    memory.unbalance_of(i) = std::abs(unbalance) > kSectionRoundOff * youngs_modulus ? unbalance : 0.0;
    worst = std::max(worst, std::abs(unbalance));
  }
  return worst <= kInBalance * 0.25 * material.yield_stress;
}

bool is_straight(const SectionRule& rule, SectionMemory memory) {
  bool straight = true;
  for (std::size_t i = 0; i < rule.section_count(); ++i) {
    straight = straight && memory.tangent_of(i) == 1.0 && memory.unbalance_of(i) == 0.0;
  }
  return straight;
}

}  // namespace cellcrush
