// Quasi-static crushes (loading.quasi_static): their plateau is that of a slow crush with real masses, the kinetic
// energy stays below the bound, and the control of the speed changes neither bits nor the ledger.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "cellcrush/spec_checker.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

using testing::HasSubstr;

SceneSpec specimen(const std::string& kind) {
  SceneSpec spec = scenes::hexagon_specimen(6, 5);
  if (kind != "hexagon") {
    spec.lattice = RegularLattice{kind, 4, 4, 4.0, kind == "square" ? 0.4 : 0.24, {}};
    spec.elements_per_wall = 4;
  }
  spec.material.hardening_modulus_mpa = 0.01 * *spec.material.youngs_modulus_mpa;
  spec.imperfection = {0.2, 1};
  spec.loading.end_strain = 0.41;
  return spec;
}

SceneSpec quasi_static(SceneSpec spec, double share = 0.01) {
  spec.loading.speed_m_per_s.reset();
  spec.loading.quasi_static = true;
  spec.loading.kinetic_share = share;
  return spec;
}

struct Crushed {
  Summary summary;
  double end = 0.0;  ///< strain
  std::int64_t steps = 0;
};

Crushed crush(const SceneSpec& spec) {
  Simulation simulation(scenes::build(spec));
  const std::vector<Sample> samples = scenes::run_to_end(simulation);
  return {summarize(simulation.scene(), samples), samples.back().strain, simulation.step()};
}

class QuasiStaticCrush : public testing::TestWithParam<const char*> {};

TEST_P(QuasiStaticCrush, HasThePlateauOfASlowOne) {
  const std::string kind = GetParam();
  const SceneSpec given = specimen(kind);
  SceneSpec slow = given;
  slow.loading.speed_m_per_s = 0.5;
  slow.loading.ramp_strain = 0.02;
  const Crushed of_speed = crush(slow);
  const double plateau = *of_speed.summary.plateau_stress_support;
  for (const double share : {0.01, 0.005}) {
    const SceneSpec spec = quasi_static(given, share);
    const Crushed found = crush(spec);
    const std::string name = kind + (share < 0.01 ? " at half the bound: " : ": ");
    scenes::record_bound(name + "support plateau in %", 100.0 * (*found.summary.plateau_stress_support / plateau - 1.0),
                         5.0);
    scenes::record_bound(name + "impact plateau in %", 100.0 * (*found.summary.plateau_stress_impact / plateau - 1.0),
                         5.0);
    EXPECT_LE(*found.summary.inertia_share, share);
    EXPECT_LT(found.summary.energy_error_relative, 0.01);
    EXPECT_NEAR(found.end, 0.41, 1e-4);
    EXPECT_EQ(found.summary.end, RunEnd::strain);
    const auto planned = facts_of(*scenes::build(spec)).step_count;
    scenes::record_bound(name + "steps over planned", static_cast<double>(found.steps) / static_cast<double>(planned),
                         4.0);
    EXPECT_LT(found.steps, of_speed.steps);
  }
}

constexpr auto kKind = [](const auto& test) { return std::string(test.param); };

INSTANTIATE_TEST_SUITE_P(Of, QuasiStaticCrush, testing::Values("hexagon"), kKind);
INSTANTIATE_TEST_SUITE_P(Long, QuasiStaticCrush, testing::Values("square", "triangle"), kKind);

TEST(QuasiStaticControl, HasTheSameBitsWhateverPiecesCheckpointsAndThreads) {
  SceneSpec spec = quasi_static(specimen("hexagon"));
  spec.loading.end_strain = 0.2;
  const auto scene = scenes::build(spec);
  Simulation whole(scene);
  scenes::run_to_end(whole);
  auto pieces = std::make_unique<Simulation>(scene, 2);
  while (!pieces->has_ended()) {
    pieces->advance(scene->schedule.step_count / 7 + 13);
    const std::string checkpoint = scenes::checkpoint_of(*pieces);
    pieces = std::make_unique<Simulation>(scene, 2);
    ASSERT_TRUE(pieces->restore(source_of(checkpoint)));
  }
  EXPECT_EQ(pieces->step(), whole.step());
  EXPECT_EQ(scenes::hash_of(pieces->state()), scenes::hash_of(whole.state()));
  EXPECT_GT(whole.step(), scene->schedule.step_count / 4);
}

TEST(QuasiStaticSpec, ExcludesWhatItChooses) {
  SceneSpec spec = specimen("hexagon");
  spec.loading.quasi_static = true;
  spec.loading.ramp_strain = 0.1;
  spec.loading.end_time_s = 1.0;
  spec.numerics.mass_scaling = 100.0;
  std::vector<std::string> fields;
  for (const Problem& problem : build_scene(spec).problems) {
    EXPECT_THAT(problem.message, HasSubstr("loading.quasi_static"));
    fields.push_back(problem.field);
  }
  EXPECT_THAT(fields, testing::ElementsAre("loading.speed_m_per_s", "loading.ramp_strain", "loading.end_time_s",
                                           "numerics.mass_scaling"));
}

// The speed of a testing machine, typed as it is, leads to the field by name.
TEST(QuasiStaticSpec, IsWhatAMillimetreAMinuteLeadsTo) {
  SceneSpec spec = specimen("hexagon");
  spec.loading.speed_m_per_s = 1e-3 / 60.0;
  const Problems notes = find_implausible(spec);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes.front().field, "loading.speed_m_per_s");
  EXPECT_THAT(notes.front().remedy, HasSubstr("loading.quasi_static"));
  spec.loading.speed_m_per_s = 1e-6;
  const Problems problems = build_scene(spec).problems;
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems.front().message, HasSubstr("steps"));
  EXPECT_THAT(problems.front().remedy, HasSubstr("loading.quasi_static"));
  EXPECT_TRUE(find_implausible(quasi_static(spec)).empty());
}

TEST(QuasiStaticSpec, TellsSpeedAndStepsBeforehand) {
  const auto scene = scenes::build(quasi_static(specimen("hexagon")));
  const SceneFacts facts = facts_of(*scene);
  EXPECT_EQ(facts.most_steps, 4 * facts.step_count);
  EXPECT_NEAR(facts.end_strain, 0.41, 1e-12);
  EXPECT_TRUE(std::ranges::any_of(facts.modelled, [](const std::string& sentence) {
    return sentence.starts_with("Speed: quasi-static, at most 4.") &&
           sentence.find("1 % of the work") != std::string::npos;
  })) << testing::PrintToString(facts.modelled);
}

}  // namespace
}  // namespace cellcrush
