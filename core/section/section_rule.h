#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Points in [-1, 1], ascending, and weights that sum to 2.
struct Quadrature {
  std::vector<double> points;
  std::vector<double> weights;
};

/// Gauss-Legendre rule, exact for polynomials of degree 2n - 1. REQUIRES: n >= 1.
Quadrature gauss_rule(int n);

/// Gauss-Lobatto rule, whose points include both ends; exact for polynomials of degree 2n - 3. REQUIRES: n >= 2.
Quadrature lobatto_rule(int n);

/// Sections along an element and points through its depth (Eq. 30; the table below E5b).
///
/// Displacement-based, as in the paper: Gauss points along the element; the curvature is linear (Eq. 27, E5a).
/// Force-based (E5b): both joints are sections, so no joint carries more moment than its section does. 3 or 5 sections
/// are Lobatto points. 4 sections are the rule of degree 3 with end weights of 1/20, the length of a plastic hinge at a
/// joint over the element length.
///
/// Through the depth, Lobatto: n points; they carry 1.079, 0.913, 1.029 ... of the full plastic moment for n = 4, 5, 6.
/// Through the depth, full moment: 4, 6 or 10 points with exact area, bending stiffness and full plastic moment. Their
/// positions minimize the greatest error of the moment between the elastic limit and the full plastic moment (5.6, 2.1
/// and 0.66 %).
/// REQUIRES: a spec that check_spec has passed.
SectionRule make_section_rule(const SectionSpec& spec);

/// Most sections along an element, and most points through its depth.
inline constexpr int kMostSections = 5;
inline constexpr int kMostDepthPoints = 10;

/// Whether the numbers of points of a rule are known at compile time: 4 x 6, force-based, the default, and 2 x 6,
/// displacement-based, the paper. Elements of other rules are computed one at a time, in double precision.
inline bool has_known_counts(const SectionRule& rule) {
  const std::size_t sections = rule.force_based ? 4 : 2;
  return rule.section_count() == sections && rule.depth_count() == 6;
}

/// How the two moments that a force-based element has in common with its neighbours act on its sections (E5b): the
/// outer moment at one end, and at the other the moment that is solved for last.
template <int kRoom, class T>
struct MomentFactors {
  T outer[kRoom];  ///< share of the outer moment in that of the section
  T shared[kRoom];
  T weighted_outer[kRoom];  ///< W_i times that share
  T weighted_shared[kRoom];
  T outer_outer[kRoom];  ///< factor of the flexibility of the section in that of the element
  T outer_shared[kRoom];
  T shared_shared[kRoom];
};

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
      along_weight[i] = static_cast<T>(weight);
      bend_start[i] = static_cast<T>(4.0 - 6.0 * s);
      bend_end[i] = static_cast<T>(2.0 - 6.0 * s);
      moment_start[i] = static_cast<T>(weight * (4.0 - 6.0 * s));
      moment_end[i] = static_cast<T>(weight * (2.0 - 6.0 * s));
      set_moments(moments[0], i, weight, 1.0 - s, s);
      set_moments(moments[1], i, weight, s, 1.0 - s);
    }
    for (int i = 0; i < depth_points(); ++i) {
      const double in_gyrations = 2.0 * std::numbers::sqrt3 * rule.offset[i];
      offset[i] = static_cast<T>(rule.offset[i]);
      arm[i] = static_cast<T>(in_gyrations);
      depth_weight[i] = static_cast<T>(rule.depth_weight[i]);
      offset_weight[i] = static_cast<T>(rule.depth_weight[i] * rule.offset[i]);
      arm_weight[i] = static_cast<T>(rule.depth_weight[i] * in_gyrations);
      square_weight[i] = static_cast<T>(rule.depth_weight[i] * in_gyrations * in_gyrations);
    }
  }

  [[nodiscard]] constexpr int sections() const { return kSections > 0 ? kSections : section_count; }
  [[nodiscard]] constexpr int depth_points() const { return kDepthPoints > 0 ? kDepthPoints : depth_count; }
  [[nodiscard]] constexpr int fibres() const { return sections() * depth_points(); }

  int section_count;
  int depth_count;
  T along_weight[kSectionRoom];  ///< W
  T bend_start[kSectionRoom];    ///< factor of theta_1 in the curvature (Eq. 27, E5a)
  T bend_end[kSectionRoom];      ///< factor of theta_2
  T moment_start[kSectionRoom];  ///< factor of the moment of the section in m_1 (Eq. 28, E7)
  T moment_end[kSectionRoom];    ///< the same in m_2
  /// Force-based (E5b). [0]: the outer moment is that at the start of the element; [1]: at its end.
  MomentFactors<kSectionRoom, T> moments[2];
  T offset[kDepthRoom];         ///< y / h
  T arm[kDepthRoom];            ///< y / gamma, of the radius of gyration
  T depth_weight[kDepthRoom];   ///< w
  T offset_weight[kDepthRoom];  ///< w y / h
  T arm_weight[kDepthRoom];     ///< w y / gamma
  T square_weight[kDepthRoom];  ///< w (y / gamma)^2

 private:
  static void set_moments(MomentFactors<kSectionRoom, T>& factors, int i, double weight, double outer, double shared) {
    factors.outer[i] = static_cast<T>(outer);
    factors.shared[i] = static_cast<T>(shared);
    factors.weighted_outer[i] = static_cast<T>(weight * outer);
    factors.weighted_shared[i] = static_cast<T>(weight * shared);
    factors.outer_outer[i] = static_cast<T>(weight * outer * outer);
    factors.outer_shared[i] = static_cast<T>(weight * outer * shared);
    factors.shared_shared[i] = static_cast<T>(weight * shared * shared);
  }
};

}  // namespace cellcrush
