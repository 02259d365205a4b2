#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "cellcrush/state.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/near_pairs.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

/// Type I at 100 m/s to 80 % strain, with crossings of walls counted on 40 frames.
struct CountedCrush {
  std::vector<Sample> samples;
  Summary summary;
  std::size_t crossings = 0;
  double deepest_birth = 0.0;
};

CountedCrush crush(SceneSpec spec) {
  spec.output.sample_count = 400;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  CountedCrush crush;
  scenes::watch(simulation, [&](const Sample& sample) {
    crush.samples.push_back(sample);
    if (crush.samples.size() % 10 == 0) {
      crush.crossings += scenes::find_crossings(*scene, simulation.state()).size();
    }
  });
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  crush.summary = summarize(*scene, crush.samples);
  crush.deepest_birth = simulation.state().contact_totals.deepest_birth;
  return crush;
}

void expect_sound_contact(const CountedCrush& crush) {
  EXPECT_EQ(crush.crossings, 0u);
  EXPECT_LT(crush.deepest_birth, 0.14);
  // The first work is that of one blow, in which all joints leave the plate in the same step. That step gives back up
  // to k (V dt)^2 / 8 more than the contact had stored: 0.5 to 0.8 % of the blow, by the phase of the step.
  for (const Sample& sample : crush.samples) {
    const double most = sample.strain < 0.003 ? 0.01 : 0.005;
    EXPECT_GE(sample.energies.contact, -most * sample.energies.external) << "at strain " << sample.strain;
  }
}

/// Eq. 52 with the jumps of the cells' motion, which knows nothing of the impact plate's stress, foretells that stress,
/// and lies closer to it than Eq. 51. One seed of an imperfection gives a plateau with a standard deviation of 1.2 to
/// 1.4 %, so a single crush is held to three and a half of them.
void expect_shock_theory(const CountedCrush& crush) {
  ASSERT_TRUE(crush.summary.front && crush.summary.shock_error() && crush.summary.front_shock_error());
  EXPECT_LT(std::abs(*crush.summary.front_shock_error()), std::abs(*crush.summary.shock_error()));
  EXPECT_GT(crush.summary.front->strain_behind, 0.89);
  EXPECT_LT(crush.summary.front->strain_behind, 0.92);
  EXPECT_EQ(crush.summary.front->window_share, 1.0);
  EXPECT_EQ(crush.summary.crush_mode, CrushMode::i);
  // Kinematics: the front advances at the jump of velocity over the jump of strain.
  const Sample* first = nullptr;
  const Sample* last = nullptr;
  for (const Sample& sample : crush.samples) {
    if (sample.front && sample.strain >= Summary::kPlateauLow && sample.strain <= Summary::kPlateauHigh) {
      first = first == nullptr ? &sample : first;
      last = &sample;
    }
  }
  const double advance = (last->front->position - first->front->position) / (last->time - first->time);
  const FrontSummary& front = *crush.summary.front;
  const double expected = (front.velocity_behind - front.velocity_ahead) / (front.strain_behind - front.strain_ahead);
  EXPECT_NEAR(advance, expected, 0.03 * expected);
}

/// A crush of Type I, whose plateau at the support (MPa) and residual (%) are to be these. The impact plate is carried
/// by inertia whatever the elements are; the support plate tells them apart. Quantities carry the elements' name.
void expect_crush(const SceneSpec& spec, const std::string& name, const scenes::Expected& support, double residual) {
  const CountedCrush counted = crush(spec);
  const Summary& summary = counted.summary;
  EXPECT_NEAR(counted.samples.back().strain, 0.8, 1e-3);
  ASSERT_TRUE(summary.plateau_stress_impact && summary.plateau_stress_support);
  scenes::record_figure(name + "impact in MPa", *summary.plateau_stress_impact, 2, {3.4, 0.3});
  scenes::record_figure(name + "support in MPa", *summary.plateau_stress_support, 2, support);
  scenes::record_bound(name + "residual in %", 100.0 * summary.energy_error_relative, residual);
  scenes::record_bound(name + "penetration over h", summary.deepest_penetration, 0.25);
  expect_sound_contact(counted);
  expect_shock_theory(counted);
  ASSERT_TRUE(summary.shock_error() && summary.front_shock_error());
  scenes::record_figure(name + "Eq. 51 in %", 100.0 * *summary.shock_error(), 1);
  scenes::record_bound(name + "Eq. 52 in %", 100.0 * *summary.front_shock_error(), 5.0);
}

TEST(TypeI, CrushAt100MetresASecondWithThePapersElementsAndStep) {
  expect_crush(scenes::papers_type_i(), "the paper's elements: ", {0.45, 0.07}, 2.5);
}

// The support stress of the paper's elements falls from 0.46 to 0.39 MPa with 8 of them a wall; ours begin below.
TEST(TypeI, CrushAt100MetresASecondByDefaultClosesItsLedgerWithinOnePercent) {
  expect_crush(scenes::preset("type-i"), "default elements: ", {0.36, 0.06}, 1.0);
}

}  // namespace
}  // namespace cellcrush
