#include <gtest/gtest.h>

#include <cmath>

#include "scenes/evidence.h"
#include "scenes/kernels.h"
#include "section/section_rule.h"

namespace cellcrush {
namespace {

constexpr double kLength = 2.0;
constexpr double kThickness = 0.3;

/// One element, straight along x, whose ends are turned.
class TurnedElement {
 public:
  TurnedElement(const Material& material, const SectionSpec& spec)
      : yield_stress_(material.yield_stress), element_(material, make_section_rule(spec)) {}

  /// Turns the ends by increments in rad; the moments are those after it, over the full plastic moment.
  void turn(double start, double end) {
    const scenes::Unit::Sums before = element_.sums();
    const double slenderness = kThickness / kLength;
    const scenes::Unit::Sums& now = element_.strain({{0.0, slenderness * start, slenderness * end}});
    plastic_work_ += kThickness * kLength * now.plastic_work;
    work_ += 0.5 * kThickness * kThickness *
             ((before.moment_start + now.moment_start) * start + (before.moment_end + now.moment_end) * end);
  }

  [[nodiscard]] double start_moment() const { return element_.sums().moment_start / (0.25 * yield_stress_); }
  [[nodiscard]] double end_moment() const { return element_.sums().moment_end / (0.25 * yield_stress_); }
  [[nodiscard]] double full_moment() const { return 0.25 * yield_stress_ * kThickness * kThickness; }
  [[nodiscard]] double plastic_work() const { return plastic_work_; }
  [[nodiscard]] double work() const { return work_; }  ///< of the end moments

  /// Greatest moment that a section lacks to the line, over the full plastic moment.
  [[nodiscard]] double unbalance() const { return element_.residual() / (0.25 * yield_stress_); }

 private:
  double yield_stress_;
  scenes::Unit element_;
  double plastic_work_ = 0.0;
  double work_ = 0.0;
};

const Material kPerfect = {69000.0, 76.0, 0.0, 1.0, 2.7e-9};

SectionSpec rule(SectionSpec::Formulation formulation) {
  SectionSpec spec;
  spec.formulation = formulation;
  return spec;
}

TEST(ForceBasedElement, IsTheCubicBeamWhileElastic) {
  TurnedElement element(kPerfect, rule(SectionSpec::Formulation::force_based));
  element.turn(1e-4, -3e-5);
  const double stiffness = 69000.0 * std::pow(kThickness, 3) / 12.0 / kLength;
  EXPECT_NEAR(element.start_moment() * element.full_moment(), stiffness * (4.0 * 1e-4 - 2.0 * 3e-5), 1e-9);
  EXPECT_NEAR(element.end_moment() * element.full_moment(), stiffness * (2.0 * 1e-4 - 4.0 * 3e-5), 1e-9);
}

// A joint that turns against a far end which bears nothing: the half wall of a lattice. The far end is turned so that
// its moment stays 0, as a free one would.
TEST(ForceBasedElement, JointBearsExactlyTheFullPlasticMoment) {
  for (const bool force_based : {true, false}) {
    TurnedElement element(kPerfect, rule(force_based ? SectionSpec::Formulation::force_based
                                                     : SectionSpec::Formulation::displacement_based));
    const double stiffness = 69000.0 * std::pow(kThickness, 3) / 12.0 / kLength;
    for (int i = 0; i < 20000; ++i) {
      element.turn(1e-5, -element.end_moment() * element.full_moment() / (4.0 * stiffness));
    }
    EXPECT_NEAR(element.start_moment(), force_based ? 1.0 : 1.268, force_based ? 1e-3 : 0.01);
    EXPECT_NEAR(element.end_moment(), 0.0, 1e-3);
    scenes::record_figure(force_based ? "force-based" : "the paper's", element.start_moment(), 4);
  }
}

// Steps in which the elastic moment would change by up to a fifth of the full plastic one, as at the front of a fast
// crush.
TEST(ForceBasedElement, KeepsItsBalanceAndItsEnergyThroughReversalsInLargeSteps) {
  TurnedElement element(kPerfect, rule(SectionSpec::Formulation::force_based));
  const int steps = 4000;
  double worst = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double phase = 2.0 * 3.14159265358979 * 5.0 * i / steps;
    element.turn(1e-3 * std::cos(phase), 7e-4 * std::cos(phase + 0.8));
    worst = std::max(worst, element.unbalance());
    EXPECT_LE(std::abs(element.start_moment()), 1.03);
    EXPECT_LE(std::abs(element.end_moment()), 1.03);
  }
  EXPECT_LT(worst, 0.12);  // of the full plastic moment, before the next step takes it up
  EXPECT_GT(element.plastic_work(), 0.0);
  // What is not dissipated is stored, and that is at most what the element stores at yield.
  const double most_stored = 0.5 * 76.0 * 76.0 / 69000.0 * kThickness * kLength;
  EXPECT_NEAR(element.work(), element.plastic_work(), most_stored + 0.01 * element.plastic_work());
}

}  // namespace
}  // namespace cellcrush
