// The return mapping of fibres, in a section that stretches or bends.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/kernels.h"
#include "section/section_rule.h"

namespace cellcrush {
namespace {

/// One section of Lobatto points through the depth, under a strain history of pure stretch or pure bending. Its element
/// is displacement-based and bends evenly.
class Section {
 public:
  Section(const Material& material, int depth_points) : element_(material, make_section_rule(lobatto(depth_points))) {}

  double stretch(double strain_increment) { return element_.strain({{strain_increment, 0.0, 0.0}}).plastic_work; }

  /// Curvature times thickness grows by `increment`. Returns the moment over b h^2, MPa.
  double bend(double increment) { return element_.strain({{0.0, 0.5 * increment, -0.5 * increment}}).moment_start; }

 private:
  static SectionSpec lobatto(int depth_points) {
    SectionSpec spec;
    spec.formulation = SectionSpec::Formulation::displacement_based;
    spec.depth_rule = SectionSpec::DepthRule::lobatto;
    spec.depth_points = depth_points;
    return spec;
  }

  scenes::Unit element_;
};

Material bilinear(double isotropic_fraction) {
  const double modulus = 70000.0;
  const double tangent = 700.0;
  return {modulus, 100.0, modulus * tangent / (modulus - tangent), isotropic_fraction, 2.7e-9};
}

// Moment over M_e = sigma_y b h^2 / 6 of a rectangular bilinear section (exact): (1 - E_T/E)(1.5 - 0.5 (k_e/k)^2) + E_T
// k/(E k_e).
TEST(Fibres, BentSectionFollowsTheExactMomentCurvatureLaw) {
  Section section(bilinear(1.0), 10);
  const double yield_curvature = 2.0 * 100.0 / 70000.0;  // times h
  const int steps = 500;
  double worst = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const double ratio = 5.0 * i / steps;
    const double moment = section.bend(5.0 * yield_curvature / steps) * 6.0 / 100.0;
    const double exact = ratio <= 1.0 ? ratio : 0.99 * (1.5 - 0.5 / (ratio * ratio)) + 0.01 * ratio;
    worst = std::max(worst, std::abs(moment / exact - 1.0));
  }
  EXPECT_LT(worst, 0.035);  // ten Lobatto points follow the spread of yield in steps of a fibre
}

TEST(Fibres, PlasticWorkOfACycleIsTheAreaOfItsLoop) {
  Section section({70000.0, 100.0, 0.0, 1.0, 2.7e-9}, 6);
  double work = 0.0;
  const int steps = 1000;
  for (const double direction : {1.0, -1.0, 1.0}) {
    for (int i = 0; i < steps; ++i) {
      work += section.stretch(direction * 0.01 / steps);
    }
  }
  const double elastic_strain = 100.0 / 70000.0;
  const double exact = 100.0 * ((0.01 - elastic_strain) + 2.0 * (0.01 - 2.0 * elastic_strain));
  EXPECT_NEAR(work, exact, 1e-9 * exact);
}

}  // namespace
}  // namespace cellcrush
