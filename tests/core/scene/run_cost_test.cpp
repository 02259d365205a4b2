// What the predicted time of a run depends on. Whether it comes true is measured: tests/load/time_forecasts.py.
#include <gtest/gtest.h>

#include <functional>

#include "cellcrush/fidelity.h"
#include "cellcrush/spec_checker.h"
#include "scenes/presets.h"

namespace cellcrush::run_costs {
namespace {

/// Over elements times steps.
double cost_of(const SceneSpec& spec) {
  const SpecChecker::Verdict verdict = SpecChecker().check(spec);
  EXPECT_TRUE(verdict.problems.empty());
  return verdict.reference_steps / static_cast<double>(verdict.element_count * verdict.step_count);
}

double cost_with(const std::function<void(SceneSpec&)>& change) {
  SceneSpec spec = scenes::preset("hexagon-small");
  spec.output.sample_count = 10;
  change(spec);
  return cost_of(spec);
}

TEST(RunCost, OfTheReferenceCrushIsOneAnElementStep) {
  EXPECT_NEAR(cost_with([](SceneSpec& spec) { spec.loading.speed_m_per_s = 20.0; }), 1.0, 0.1);
}

TEST(RunCost, OfTypeIIsThatMeasured) { EXPECT_NEAR(cost_of(scenes::preset("type-i")), 1.55, 0.1); }

TEST(RunCost, RisesWithSpeedLawsSamplesAndPrecision) {
  const double plain = cost_with([](SceneSpec&) {});
  EXPECT_LT(cost_with([](SceneSpec& spec) { spec.loading.speed_m_per_s = 2.0; }), 0.7 * plain);
  EXPECT_GT(cost_with([](SceneSpec& spec) { spec.output.sample_count = 1000; }), 1.2 * plain);
  EXPECT_GT(cost_with([](SceneSpec& spec) { spec.material.hardening_modulus_mpa = 690.0; }), 1.2 * plain);
  const auto voce = [](SceneSpec& spec) {
    spec.material.voce_stress_mpa = 60.0;
    spec.material.voce_exponent = 20.0;
  };
  EXPECT_GT(cost_with(voce), 3.0 * plain);
  EXPECT_GT(cost_with([&](SceneSpec& spec) {
              voce(spec);
              spec.material.cowper_symonds_rate_per_s = 6500.0;
              spec.material.cowper_symonds_exponent = 4.0;
            }),
            2.0 * cost_with(voce));
  EXPECT_LT(cost_with([](SceneSpec& spec) {
              spec.section.formulation = SectionSpec::Formulation::displacement_based;
              spec.elements_per_wall = 2;
            }),
            0.7 * plain);
}

}  // namespace
}  // namespace cellcrush::run_costs
