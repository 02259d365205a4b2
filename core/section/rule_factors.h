#pragma once

#include <cstddef>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Most sections along an element, and most points through its depth.
inline constexpr int kMostSections = 5;
inline constexpr int kMostDepthPoints = 10;

/// Whether the numbers of points of a rule are known at compile time: 4 x 6, force-based, the default, and 2 x 6,
/// displacement-based, the paper. Elements of other rules are computed one at a time.
inline bool has_known_counts(const SectionRule& rule) {
  const std::size_t sections = rule.force_based ? 4 : 2;
  return rule.section_count() == sections && rule.depth_count() == 6;
}

/// The factors of a section rule in the precision of the fibres, computed once for all elements. Numbers of points that
/// are known at compile time give loops that are unrolled; 0 stands for the number of the rule.
template <int kSections, int kDepthPoints, class T>
struct RuleFactors {
  using Number = T;

  static constexpr bool kIsFixed = kSections > 0 && kDepthPoints > 0;
  static constexpr int kSectionRoom = kSections > 0 ? kSections : kMostSections;
  static constexpr int kDepthRoom = kDepthPoints > 0 ? kDepthPoints : kMostDepthPoints;

  explicit RuleFactors(const SectionRule& rule)
      : section_count(static_cast<int>(rule.section_count())), depth_count(static_cast<int>(rule.depth_count())) {
    for (int i = 0; i < sections(); ++i) {
      const double s = rule.along[i];
      const double weight = rule.along_weight[i];
      along[i] = static_cast<T>(s);
      along_weight[i] = static_cast<T>(weight);
      bend_start[i] = static_cast<T>(4.0 - 6.0 * s);
      bend_end[i] = static_cast<T>(2.0 - 6.0 * s);
      moment_start[i] = static_cast<T>(weight * (4.0 - 6.0 * s));
      moment_end[i] = static_cast<T>(weight * (2.0 - 6.0 * s));
      turn_start[i] = static_cast<T>(weight * (1.0 - s));
      turn_end[i] = static_cast<T>(weight * s);
      turn_start_start[i] = static_cast<T>(weight * (1.0 - s) * (1.0 - s));
      turn_start_end[i] = static_cast<T>(weight * (1.0 - s) * s);
      turn_end_end[i] = static_cast<T>(weight * s * s);
    }
    for (int i = 0; i < depth_points(); ++i) {
      offset[i] = static_cast<T>(rule.offset[i]);
      depth_weight[i] = static_cast<T>(rule.depth_weight[i]);
    }
  }

  [[nodiscard]] int sections() const { return kSections > 0 ? kSections : section_count; }
  [[nodiscard]] int depth_points() const { return kDepthPoints > 0 ? kDepthPoints : depth_count; }
  [[nodiscard]] int fibres() const { return sections() * depth_points(); }

  int section_count;
  int depth_count;
  T along[kSectionRoom];  ///< s
  T along_weight[kSectionRoom];
  T bend_start[kSectionRoom];        ///< factor of theta_1 in the curvature (Eq. 27, E5a)
  T bend_end[kSectionRoom];          ///< factor of theta_2
  T moment_start[kSectionRoom];      ///< factor of the moment of the section in m_1 (Eq. 28, E7)
  T moment_end[kSectionRoom];        ///< the same in m_2
  T turn_start[kSectionRoom];        ///< factor of the curvature of the section in theta_1 (E5b)
  T turn_end[kSectionRoom];          ///< the same in -theta_2
  T turn_start_start[kSectionRoom];  ///< factor of the flexibility of the section in that of the element (E5b)
  T turn_start_end[kSectionRoom];
  T turn_end_end[kSectionRoom];
  T offset[kDepthRoom];  ///< y / h
  T depth_weight[kDepthRoom];
};

}  // namespace cellcrush
