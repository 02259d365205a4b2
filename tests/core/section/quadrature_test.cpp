
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Whether a rule is exact up to a degree, and not beyond.
void expect_exact_to(int degree, const Quadrature& rule) {
  const auto error = [&](int power) {
    return integrate_power(rule, power) - (power % 2 == 1 ? 0.0 : 2.0 / (power + 1));
  };
  for (int power = 0; power <= degree; ++power) {
    EXPECT_NEAR(error(power), 0.0, 1e-13) << rule.points.size() << " points, power " << power;
  }
  EXPECT_GT(std::abs(error(degree + 1)), 1e-7) << rule.points.size();
}

TEST(Quadrature, GaussIsExactToDegreeTwiceThePointsLessOneAndLobattoLessThreeWithTheEnds) {
  for (int n = 1; n <= 10; ++n) expect_exact_to(2 * n - 1, gauss_rule(n));
  for (int n = 2; n <= 10; ++n) {
    const Quadrature rule = lobatto_rule(n);
    EXPECT_DOUBLE_EQ(rule.points.front(), -1.0);
    EXPECT_DOUBLE_EQ(rule.points.back(), 1.0);
    expect_exact_to(2 * n - 3, rule);
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

// Unit E, b, h, l: moments of theta_1 are 4 EI/l and 2 EI/l, and stretch makes no moment. Full-moment rules have the
// exact full plastic moment, force-based rules a section at either joint.
TEST(SectionRule, HasTheElasticStiffnessOfACubicBeamTheFullMomentAndTheJoints) {
  using Formulation = SectionSpec::Formulation;
  using DepthRule = SectionSpec::DepthRule;
  constexpr auto kArea = SectionSpec().area_rule;
  for (const SectionSpec& spec : {SectionSpec{Formulation::displacement_based, DepthRule::lobatto, kArea, 2, 6},
                                  SectionSpec{Formulation::displacement_based, DepthRule::full_moment, kArea, 3, 4},
                                  SectionSpec{Formulation::force_based, DepthRule::full_moment, kArea, 3, 6},
                                  SectionSpec{Formulation::force_based, DepthRule::full_moment, kArea, 4, 4},
                                  SectionSpec{Formulation::force_based, DepthRule::full_moment, kArea, 4, 10},
                                  SectionSpec{Formulation::force_based, DepthRule::lobatto, kArea, 5, 10}}) {
    const SectionRule rule = make_section_rule(spec);
    EXPECT_NEAR((rule.depth_weight * rule.offset.square()).sum(), 1.0 / 12.0, 1e-14);
    const Eigen::ArrayXd start = 4.0 - 6.0 * rule.along;
    const Eigen::ArrayXd end = 2.0 - 6.0 * rule.along;
    EXPECT_NEAR((rule.along_weight * start * start).sum(), 4.0, 1e-13);
    EXPECT_NEAR((rule.along_weight * start * end).sum(), 2.0, 1e-13);
    EXPECT_NEAR((rule.depth_weight * rule.offset).sum(), 0.0, 1e-15);
    EXPECT_NEAR(rule.along_weight.sum(), 1.0, 1e-14);
    EXPECT_NEAR(rule.depth_weight.sum(), 1.0, 1e-14);
    EXPECT_GT(rule.along_weight.minCoeff(), 0.0);
    EXPECT_GT(rule.depth_weight.minCoeff(), 0.0);
    if (spec.depth_rule == DepthRule::full_moment) {
      EXPECT_NEAR((rule.depth_weight * rule.offset.abs()).sum(), 0.25, 1e-14);
    }
    if (spec.formulation == Formulation::force_based) {
      EXPECT_EQ(rule.along[0], 0.0);
      EXPECT_EQ(rule.along[rule.along.size() - 1], 1.0);
    }
  }
}

/// Greatest error of the moment of a perfectly plastic section as it is bent beyond its yield curvature.
double worst_moment_error(int depth_points) {
  SectionSpec spec;
  spec.depth_points = depth_points;
  const SectionRule rule = make_section_rule(spec);
  double worst = 0.0;
  for (double curvature = 1.0; curvature < 100.0; curvature *= 1.001) {  // over that at yield
    const double moment =
        (rule.depth_weight * rule.offset.abs() * (2.0 * curvature * rule.offset.abs()).min(1.0)).sum();
    const double exact = 0.25 - 1.0 / (12.0 * curvature * curvature);
    worst = std::max(worst, std::abs(moment / exact - 1.0));
  }
  return worst;
}

TEST(SectionRule, HasTheMomentOfABentSection) {
  for (const auto& [points, bound] : {std::pair(4, 0.0563), std::pair(6, 0.0214), std::pair(10, 0.0066)}) {
    EXPECT_NEAR(worst_moment_error(points), bound, 0.02 * bound) << points;
  }
}

}  // namespace
}  // namespace cellcrush
