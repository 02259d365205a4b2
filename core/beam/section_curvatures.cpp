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

template <class T>
PerSection balanced_curvatures(const SectionRule& rule, const Material& material, const EndMoments& moments,
                               SectionMemory<T> memory, double bend_start, double bend_end) {
  const std::size_t count = rule.section_count();
  const double elastic = 12.0 / material.youngs_modulus;  // h times curvature, over moment by b h^2
  const double round_off = kSectionRoundOff<T> * material.yield_stress;
  PerSection curvature;
  for (bool turned_back = true; turned_back;) {
    Flexibility flexibility;
    for (std::size_t i = 0; i < count; ++i) {
      const double s = rule.along[static_cast<Eigen::Index>(i)];
      const double weighted = rule.along_weight[static_cast<Eigen::Index>(i)] * elastic * memory.flexibility_of(i);
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
      curvature[i] = elastic * memory.flexibility_of(i) * (increment.at(s) + memory.unbalance_of(i));
      const double moment = moments.at(s) - memory.unbalance_of(i);
      if (memory.flexibility_of(i) > 1.0 && std::abs(moment) > round_off && curvature[i] * moment < 0.0) {
        memory.flexibility_of(i) = T(1.0);
        turned_back = true;
      }
    }
  }
  return curvature;
}

template <class T>
PerSection moments_of_sections(const SectionRule& rule, const EndMoments& moments, SectionMemory<T> memory) {
  PerSection moment;
  for (std::size_t i = 0; i < rule.section_count(); ++i) {
    moment[i] = moments.at(rule.along[static_cast<Eigen::Index>(i)]) - memory.unbalance_of(i);
  }
  return moment;
}

template <class T>
bool remember_sections(const SectionRule& rule, const Material& material, const PerSection& before,
                       const ElementSums& now, const PerSection& curvature, SectionMemory<T> memory) {
  const double round_off = kSectionRoundOff<T> * material.yield_stress;
  double worst = 0.0;
  for (std::size_t i = 0; i < rule.section_count(); ++i) {
    const double s = rule.along[static_cast<Eigen::Index>(i)];
    const double elastic_increment = material.youngs_modulus / 12.0 * curvature[i];
    if (std::abs(elastic_increment) > round_off) {
      memory.flexibility_of(i) = static_cast<T>(shown_flexibility<T>(elastic_increment, now.moment[i] - before[i]));
    }
    const double unbalance = now.moments.at(s) - now.moment[i];
    memory.unbalance_of(i) = static_cast<T>(std::abs(unbalance) > round_off ? unbalance : 0.0);
    worst = std::max(worst, std::abs(unbalance));
  }
  return worst <= kInBalance * 0.25 * material.yield_stress;
}

template <class T>
bool is_straight(const SectionRule& rule, SectionMemory<T> memory) {
  bool straight = true;
  for (std::size_t i = 0; i < rule.section_count(); ++i) {
    straight = straight && memory.flexibility_of(i) == 1.0 && memory.unbalance_of(i) == 0.0;
  }
  return straight;
}

#define CELLCRUSH_INSTANTIATE(T)                                                                                    \
  template PerSection balanced_curvatures(const SectionRule&, const Material&, const EndMoments&, SectionMemory<T>, \
                                          double, double);                                                          \
  template PerSection moments_of_sections(const SectionRule&, const EndMoments&, SectionMemory<T>);                 \
  template bool remember_sections(const SectionRule&, const Material&, const PerSection&, const ElementSums&,       \
                                  const PerSection&, SectionMemory<T>);                                             \
  template bool is_straight(const SectionRule&, SectionMemory<T>);

CELLCRUSH_INSTANTIATE(double)
CELLCRUSH_INSTANTIATE(float)

}  // namespace cellcrush
