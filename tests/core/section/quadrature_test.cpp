
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/evidence.h"
#include "section/section_rule.h"

namespace cellcrush {
namespace {

double integrate_power(const Quadrature& rule, int power) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    sum += rule.weights[i] * std::pow(rule.points[i], power);
  }
  return sum;
}

double exact_integral(int power) { return power % 2 == 1 ? 0.0 : 2.0 / (power + 1); }

TEST(Quadrature, GaussIsExactToDegreeTwiceThePointsLessOne) {
  for (int n = 1; n <= 10; ++n) {
    for (int power = 0; power <= 2 * n - 1; ++power) {
      EXPECT_NEAR(integrate_power(gauss_rule(n), power), exact_integral(power), 1e-13)
          << n << " points, power " << power;
    }
    EXPECT_GT(std::abs(integrate_power(gauss_rule(n), 2 * n) - exact_integral(2 * n)), 1e-7);
  }
}

TEST(Quadrature, LobattoIsExactToDegreeTwiceThePointsLessThreeAndHasTheEnds) {
  for (int n = 2; n <= 10; ++n) {
    const Quadrature rule = lobatto_rule(n);
    EXPECT_DOUBLE_EQ(rule.points.front(), -1.0);
    EXPECT_DOUBLE_EQ(rule.points.back(), 1.0);
    for (int power = 0; power <= 2 * n - 3; ++power) {
      EXPECT_NEAR(integrate_power(rule, power), exact_integral(power), 1e-13) << n << " points, power " << power;
    }
    EXPECT_GT(std::abs(integrate_power(rule, 2 * n - 2) - exact_integral(2 * n - 2)), 1e-7);
  }
}

// Full plastic moment over the exact b h^2 / 4 sigma_y, by depth rule: sum of w |eta| with every fibre at yield.
TEST(Quadrature, LobattoSectionHasItsKnownFullPlasticMoment) {
  const std::pair<int, double> known[] = {{4, 1.0787}, {5, 0.9128}, {6, 1.0290},
                                          {7, 0.9597}, {8, 1.0151}, {10, 1.0093}};
  double worst = 0.0;
  for (const auto& [points, ratio] : known) {
    const Quadrature rule = lobatto_rule(points);
    double moment = 0.0;
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      moment += rule.weights[i] * std::abs(rule.points[i]);
    }
    EXPECT_NEAR(moment, ratio, 1e-4) << points << " points";
    worst = std::max(worst, std::abs(moment - ratio));
  }
  scenes::record_figure("worst error", worst, 1);
}

SectionSpec section(SectionSpec::Formulation formulation, int axial_points, SectionSpec::DepthRule depth_rule,
                    int depth_points) {
  SectionSpec spec;
  spec.formulation = formulation;
  spec.depth_rule = depth_rule;
  spec.axial_points = axial_points;
  spec.depth_points = depth_points;
  return spec;
}

const SectionSpec kSpecs[] = {
    section(SectionSpec::Formulation::displacement_based, 2, SectionSpec::DepthRule::lobatto, 6),
    section(SectionSpec::Formulation::displacement_based, 3, SectionSpec::DepthRule::full_moment, 4),
    section(SectionSpec::Formulation::force_based, 3, SectionSpec::DepthRule::full_moment, 6),
    section(SectionSpec::Formulation::force_based, 4, SectionSpec::DepthRule::full_moment, 4),
    section(SectionSpec::Formulation::force_based, 5, SectionSpec::DepthRule::lobatto, 10),
};

TEST(SectionRule, GivesTheElasticStiffnessOfACubicBeam) {
  // Unit E, b, h, l: moments of theta_1 are 4 EI/l and 2 EI/l, and stretch makes no moment.
  for (const SectionSpec& spec : kSpecs) {
    const SectionRule rule = make_section_rule(spec);
    const double inertia = (rule.depth_weight * rule.offset.square()).sum();
    EXPECT_NEAR(inertia, 1.0 / 12.0, 1e-14);
    const Eigen::ArrayXd start = 4.0 - 6.0 * rule.along;
    const Eigen::ArrayXd end = 2.0 - 6.0 * rule.along;
    EXPECT_NEAR((rule.along_weight * start * start).sum(), 4.0, 1e-13);
    EXPECT_NEAR((rule.along_weight * start * end).sum(), 2.0, 1e-13);
    EXPECT_NEAR((rule.depth_weight * rule.offset).sum(), 0.0, 1e-15);
    EXPECT_NEAR(rule.along_weight.sum(), 1.0, 1e-14);
    EXPECT_NEAR(rule.depth_weight.sum(), 1.0, 1e-14);
    EXPECT_GT(rule.along_weight.minCoeff(), 0.0);
    EXPECT_GT(rule.depth_weight.minCoeff(), 0.0);
  }
}

TEST(SectionRule, FullMomentRulesHaveTheExactFullPlasticMoment) {
  for (const int points : {4, 6}) {
    SectionSpec spec;
    spec.depth_points = points;
    const SectionRule rule = make_section_rule(spec);
    EXPECT_NEAR((rule.depth_weight * rule.offset.abs()).sum(), 0.25, 1e-14) << points << " points";
  }
}

TEST(SectionRule, ForceBasedRulesHaveASectionAtEitherJoint) {
  for (const int points : {3, 4, 5}) {
    SectionSpec spec;
    spec.axial_points = points;
    const SectionRule rule = make_section_rule(spec);
    EXPECT_EQ(rule.along[0], 0.0);
    EXPECT_EQ(rule.along[points - 1], 1.0);
  }
}

}  // namespace
}  // namespace cellcrush
