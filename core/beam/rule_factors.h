#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// The factors of a section rule as the vector kernels use them, made once for all elements.
template <int kSections, int kDepthPoints>
struct RuleFactors {
  explicit RuleFactors(const SectionRule& rule) {
    for (int i = 0; i < kSections; ++i) {
      along[i] = rule.along[i];
      along_weight[i] = rule.along_weight[i];
      bend_start[i] = 4.0 - 6.0 * along[i];
      bend_end[i] = 2.0 - 6.0 * along[i];
      moment_start[i] = along_weight[i] * bend_start[i];
      moment_end[i] = along_weight[i] * bend_end[i];
    }
    for (int i = 0; i < kDepthPoints; ++i) {
      offset[i] = rule.offset[i];
      depth_weight[i] = rule.depth_weight[i];
    }
  }

  double along[kSections];
  double along_weight[kSections];
  double bend_start[kSections];    ///< of the rotation of the start, in the curvature (Eq. 27)
  double bend_end[kSections];      ///< the same of the end
  double moment_start[kSections];  ///< of the section's moment, in the moment on the start (Eq. 28)
  double moment_end[kSections];
  double offset[kDepthPoints];
  double depth_weight[kDepthPoints];
};

}  // namespace cellcrush
