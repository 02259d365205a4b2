#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Most sections along an element, and most fibres in it.
inline constexpr std::size_t kMostSections = 5;
inline constexpr std::size_t kMostFibres = 10 * kMostSections;

/// Most that a section is given, of the elastic flexibility: it keeps the element's finite.
inline constexpr double kMostFlexibility = 100.0;
/// Sections that are more flexible than elastic ones by less are elastic.
template <class T>
inline constexpr T kElasticBelow = std::is_same_v<T, double> ? T(1.0 + 1e-6) : T(1.01);
/// Moments over b h^2 that are nothing, of the yield stress.
template <class T>
inline constexpr T kSectionRoundOff = std::is_same_v<T, double> ? T(6e-10) : T(2e-6);
/// Unbalance that is left to the next step, of the full plastic moment.
inline constexpr double kInBalance = 0.02;
using PerSection = std::array<double, kMostSections>;

/// What the sections of a force-based element remember from step to step, in the state's arrays.
template <class T>
struct SectionMemory {
  T* unbalance;            ///< moment that the section lacks to the line through the end moments, over b h^2, MPa
  T* flexibility;          ///< that it showed in the newest step, of the elastic one, 1 ... kMostFlexibility
  std::size_t stride = 1;  ///< from a section to the next

  [[nodiscard]] T& unbalance_of(std::size_t section) const { return unbalance[section * stride]; }
  [[nodiscard]] T& flexibility_of(std::size_t section) const { return flexibility[section * stride]; }
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
/// sections' flexibility is what they showed last; what it is wrong by is the unbalance, for another pass or the next step.
/// A section that has flowed but now turns back is taken as elastic; one that was squashed and bears no moment has no back.
template <class T>
PerSection balanced_curvatures(const SectionRule& rule, const Material& material, const EndMoments& moments,
                               SectionMemory<T> memory, double bend_start, double bend_end);

/// Moments of the sections over b h^2 that the memory tells, MPa.
template <class T>
PerSection moments_of_sections(const SectionRule& rule, const EndMoments& moments, SectionMemory<T> memory);

/// Flexibility of a section, of the elastic one, whose moment over b h^2 rose by `gained` where it would have risen by
/// `elastic`, not 0, had it been elastic.
template <class T>
double shown_flexibility(double elastic, double gained) {
  const double flexibility = elastic / gained;
  if (!(flexibility > 0.0 && flexibility < kMostFlexibility)) {
    return kMostFlexibility;
  }
  return flexibility < kElasticBelow<T> ? 1.0 : flexibility;
}

/// Brings the memory up to date after the sections' moments have gone from `before` to those of `now` under increments of
/// curvature times h. Returns whether every section is in balance to 2 % of the full plastic moment.
template <class T>
bool remember_sections(const SectionRule& rule, const Material& material, const PerSection& before,
                       const ElementSums& now, const PerSection& curvature, SectionMemory<T> memory);

/// Whether the curvature of an element at rest in `memory` is a straight line: all sections elastic and balanced.
template <class T>
bool is_straight(const SectionRule& rule, SectionMemory<T> memory);

}  // namespace cellcrush
