#pragma once

#include <array>
#include <cstddef>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Most sections along an element, and most fibres in it.
inline constexpr std::size_t kMostSections = 5;
inline constexpr std::size_t kMostFibres = 10 * kMostSections;

/// Least share of the elastic stiffness that a section is given: it keeps the element's flexibility finite.
inline constexpr double kLeastTangent = 0.01;
/// Moments that are nothing, over b h^2 E, and curvatures that are, times h.
inline constexpr double kSectionRoundOff = 1e-12;
/// Unbalance that is left to the next step, of the full plastic moment.
inline constexpr double kInBalance = 0.02;
using PerSection = std::array<double, kMostSections>;

/// What the sections of a force-based element remember from step to step, in the state's arrays.
struct SectionMemory {
  double* unbalance;       ///< moment that the section lacks to the line through the end moments, over b h^2, MPa
  double* tangent;         ///< share of the elastic bending stiffness that it showed in the newest step
  std::size_t stride = 1;  ///< from a section to the next

  [[nodiscard]] double& unbalance_of(std::size_t section) const { return unbalance[section * stride]; }
  [[nodiscard]] double& tangent_of(std::size_t section) const { return tangent[section * stride]; }
};

/// End moments over b h^2, MPa: what sections' moments do work with on the nodes' rotations (Eq. 28).
struct EndMoments {
  double start = 0.0;
  double end = 0.0;

  /// Moment at s on the line between them.
  [[nodiscard]] double at(double s) const { return (1.0 - s) * start - s * end; }
};

/// What the sections of an element sum to (Eq. 28, row by row), before its area and thickness are put on. MPa.
struct ElementSums {
  double axial = 0.0;
  EndMoments moments;
  double plastic_work = 0.0;
  PerSection moment{};  ///< of each section
};

/// Increments of curvature times h that are a straight line along the element (Eq. 27), from the end rotations times h / l.
inline PerSection straight_curvatures(const SectionRule& rule, double bend_start, double bend_end) {
  PerSection curvature;
  for (std::size_t i = 0; i < rule.section_count(); ++i) {
    const double s = rule.along[static_cast<Eigen::Index>(i)];
    curvature[i] = (4.0 - 6.0 * s) * bend_start + (2.0 - 6.0 * s) * bend_end;
  }
  return curvature;
}

/// Increments of curvature times h with which the moment becomes a straight line along the element, as equilibrium has it,
/// and that add up to the end rotations times h / l (force-based element of Spacone, Filippou and Taucer, 1996). The
/// sections' stiffness is what they showed last; what it is wrong by is the unbalance, for another pass or the next step.
/// A section that has flowed but now turns back is taken as elastic; one that was squashed and bears no moment has no back.
PerSection balanced_curvatures(const SectionRule& rule, const Material& material, const EndMoments& moments,
                               SectionMemory memory, double bend_start, double bend_end);

/// Moments of the sections over b h^2 that the memory tells, MPa.
PerSection moments_of_sections(const SectionRule& rule, const EndMoments& moments, SectionMemory memory);

/// Brings the memory up to date after the sections' moments have gone from `before` to those of `now` under increments of
/// curvature times h. Returns whether every section is in balance to 2 % of the full plastic moment.
bool remember_sections(const SectionRule& rule, const Material& material, const PerSection& before,
                       const ElementSums& now, const PerSection& curvature, SectionMemory memory);

/// Whether the curvature of an element at rest in `memory` is a straight line: all sections elastic and balanced.
bool is_straight(const SectionRule& rule, SectionMemory memory);

}  // namespace cellcrush
