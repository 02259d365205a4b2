#pragma once

#include <cstdint>
#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush::scenes {

// The laws that run, on the SIMD target in use, for one element.

/// See turn_between in beam/deformation-inl.h.
double turn_between(const Vector2& from, const Vector2& to);

/// See Deformation in beam/deformation-inl.h.
struct ElementDeformation {
  double stretch;
  double rotation_start;
  double rotation_end;
};
ElementDeformation reverse_motion(const Vector2& span, const Vector2& previous_axis, double previous_length,
                                  double turn_start, double turn_end);

/// Share of the modulus of an element of constant volume, alone or in a pair, with a factor on its rotary inertia; see
/// CrossSection in beam/cross_section-inl.h.
double modulus_share(double length, double undeformed, double thickness, bool in_pairs, double rotary);

/// Strain increments of an element; see ElementStrains in beam/element_response-inl.h. Of a pair, bend_start of the
/// second element is the turn between both, and bend_end of the first has no effect.
struct StepStrains {
  double membrane = 0.0;
  double bend_start = 0.0;
  double bend_end = 0.0;
};

/// One element, or a pair of force-based ones, of any section rule, with its history in double precision.
class Unit {
 public:
  Unit(const Material& material, const SectionRule& rule, int elements = 1);

  /// Sums over the fibres of an element after a step; see ElementSums in beam/element_response-inl.h. MPa.
  struct Sums {
    double axial = 0.0;
    double moment_start = 0.0;
    double moment_end = 0.0;
    double plastic_work = 0.0;
  };
  /// A step with the strains of each element. Returns the sums of the first.
  const Sums& strain(const std::vector<StepStrains>& strains);

  [[nodiscard]] const Sums& sums(int element = 0) const { return elements_[element].sums; }
  [[nodiscard]] const std::vector<double>& stress(int element = 0) const { return elements_[element].stress; }
  /// Greatest axial force over A, and moment over A h, that a section bears more or less than the forces of the unit
  /// ask for, MPa. Force-based elements only.
  [[nodiscard]] double residual() const;

 private:
  struct Element {
    std::vector<double> stress;
    std::vector<double> back_stress;
    std::vector<double> plastic_strain;
    std::vector<double> section_axial;
    std::vector<double> section_moment;
    std::uint64_t yielding = 0;
    Sums sums;
  };

  Material material_;
  SectionRule rule_;
  std::vector<Element> elements_;
};

}  // namespace cellcrush::scenes
