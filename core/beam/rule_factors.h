#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// The factors of a section rule as the vector kernels use them, made once for all elements.
template <int kSections, int kDepthPoints, class T>
struct RuleFactors {
  explicit RuleFactors(const SectionRule& rule) {
    for (int i = 0; i < kSections; ++i) {
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
    for (int i = 0; i < kDepthPoints; ++i) {
      offset[i] = static_cast<T>(rule.offset[i]);
      depth_weight[i] = static_cast<T>(rule.depth_weight[i]);
    }
  }

  T along[kSections];
  T along_weight[kSections];
  T bend_start[kSections];    ///< of the rotation of the start, in the curvature (Eq. 27)
  T bend_end[kSections];      ///< the same of the end
  T moment_start[kSections];  ///< of the section's moment, in the moment on the start (Eq. 28)
  T moment_end[kSections];
  T turn_start[kSections];  ///< of the section's curvature, in the rotation of the start
  T turn_end[kSections];    ///< the same of the end
  double
      turn_start_start[kSections];  ///< of the section's flexibility, in the element's (Eq. 27 with a straight moment)
  T turn_start_end[kSections];
  T turn_end_end[kSections];
  T offset[kDepthPoints];
  T depth_weight[kDepthPoints];
};

}  // namespace cellcrush
