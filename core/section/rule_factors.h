#pragma once

#include <cstddef>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Most sections along an element, and most points through its depth.
inline constexpr int kMostSections = 5;
inline constexpr int kMostDepthPoints = 10;

/// Whether the counts of a rule's points are known at compile time: the default's 4 x 6, force-based, and the paper's 2
/// x 6, displacement-based. Elements of other rules are computed one by one.
inline bool has_known_counts(const SectionRule& rule) {
  const std::size_t sections = rule.force_based ? 4 : 2;
  return rule.section_count() == sections && rule.depth_count() == 6;
}

/// The factors of a section rule in the precision of the fibres, made once for all elements. Counts that are known at
/// compile time make straight code; 0 takes the rule's.
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
  T bend_start[kSectionRoom];        ///< of the rotation of the start, in the curvature (Eq. 27)
  T bend_end[kSectionRoom];          ///< the same of the end
  T moment_start[kSectionRoom];      ///< of the section's moment, in the moment on the start (Eq. 28)
  T moment_end[kSectionRoom];        ///< the same on the end
  T turn_start[kSectionRoom];        ///< of the section's curvature, in the rotation of the start
  T turn_end[kSectionRoom];          ///< the same of the end
  T turn_start_start[kSectionRoom];  ///< of the section's flexibility, in the element's (Eq. 27, moment linear)
  T turn_start_end[kSectionRoom];
  T turn_end_end[kSectionRoom];
  T offset[kDepthRoom];  ///< y / h
  T depth_weight[kDepthRoom];
};

}  // namespace cellcrush
