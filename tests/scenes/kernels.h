#pragma once

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

/// Share of the modulus of an element of constant volume; see CrossSection in beam/cross_section-inl.h.
double modulus_share(double length, double undeformed, double thickness);

/// An element of any section rule with its history, in double precision.
class OneElement {
 public:
  OneElement(const Material& material, const SectionRule& rule);

  /// Sums over the fibres after a step; see ElementSums in beam/section_balance-inl.h. MPa.
  struct Sums {
    double axial = 0.0;
    double moment_start = 0.0;
    double moment_end = 0.0;
    double plastic_work = 0.0;
  };
  /// `membrane`: increment of strain; bends: increments of the end rotations times h / l.
  const Sums& strain(double membrane, double bend_start, double bend_end);

  [[nodiscard]] const Sums& sums() const { return sums_; }
  [[nodiscard]] const std::vector<double>& stress() const { return stress_; }
  [[nodiscard]] const std::vector<double>& plastic_strain() const { return plastic_strain_; }
  /// Greatest moment over b h^2 that a section lacks to the line through the end moments, MPa.
  [[nodiscard]] double residual() const;

 private:
  Material material_;
  SectionRule rule_;
  std::vector<double> stress_;
  std::vector<double> back_stress_;
  std::vector<double> plastic_strain_;
  std::vector<double> unbalance_;
  std::vector<double> flexibility_;
  Sums sums_;
};

}  // namespace cellcrush::scenes
