#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/presets.h"
#include "scenes/state_hash.h"
#include "stability/watched_run.h"
#include "step/check_run.h"

namespace cellcrush {
namespace {

// What a scene without imperfection, or bits that are not repeated, decide by chance.

/// A straight elastic column, clamped at both ends, that is shortened by six times its buckling strain within some
/// periods of its buckling; its middle stands aside by `offset` mm.
struct Column {
  static constexpr double kLength = 20.0;  // mm
  double aside = 0.0;                      ///< of its middle in the end, mm

  explicit Column(double offset) {
    constexpr double kPress = 2e-4;  // s
    FrameLattice frame =
        scenes::touching_beams({{0.0, 0.0}, {0.5 * kLength, offset}, {kLength, 0.0}}, {{0, 1}, {1, 2}}, 0.2, 4);
    frame.self_contact = false;
    frame.supports = {{0, true, true, true}, {2, false, true, true}};
    frame.end_time_s = kPress;
    frame.motions = {{2, FrameLattice::Component::x, {{0.0, 0.0}, {kPress, -0.002 * kLength}}}};
    frame.watched_nodes = {1};
    aside = std::abs(offset + scenes::run_frame(scenes::elastic_frame(frame)).back().watched.front().uy);
  }
};

// A column that stands exactly straight bears six times its buckling load: no force points aside but round-off. A
// thousandth of its length is enough; lattices get theirs from a seed (Imperfection.IsBoundedSeededAndRepeatable).
TEST(PerfectSymmetry, NeverBucklesAndASmallImperfectionDoes) {
  const Column perfect(0.0);
  const Column imperfect(0.001 * Column::kLength);
  EXPECT_LT(perfect.aside, 1e-6);
  EXPECT_GT(imperfect.aside, 0.2);
}

State crush_with(double amplitude) {
  SceneSpec spec = scenes::hexagon_specimen(12, 6);
  spec.imperfection = {amplitude, 1};
  spec.loading.end_strain = 0.6;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  simulation.advance(scene->schedule.step_count);
  return simulation.state();
}

// A change of the size of round-off chooses another way to fold: sums in the order in which threads happen to end would
// do the same. Sums in a fixed order give the same bits again.
TEST(RoundOff, ChoosesTheFoldsUnlessSumsHaveAFixedOrder) {
  const State first = crush_with(1e-3);
  const State nearly = crush_with(1e-3 * (1.0 + 1e-12));
  EXPECT_GT(scenes::distance_between(first, nearly), 0.1);
  EXPECT_EQ(scenes::hash_of(first), scenes::hash_of(crush_with(1e-3)));
}

// What makes a slow crush another one than was asked for, and how its result shows it.

/// A small specimen crushed across its rows, so slowly that both plates feel the same.
SceneSpec slow_specimen() {
  SceneSpec spec = scenes::hexagon_specimen(5, 4);
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.loading.speed_m_per_s = 2.0;
  spec.loading.end_strain = 0.2;
  spec.numerics.mass_damping_per_s = 1000.0;
  spec.imperfection = {0.01, 1};
  return spec;
}

stability::WatchedRun run(const SceneSpec& spec) {
  stability::WatchedRun crush(spec);
  EXPECT_EQ(crush.status.kind, RunStatus::Kind::finished) << crush.status.message;
  return crush;
}

/// Difference of the plates' mean stresses, of the mean of both.
double difference_of(const SceneSpec& spec) {
  const auto crush = run(spec);
  EXPECT_TRUE(crush.summary.quasi_static);
  return crush.summary.quasi_static ? crush.summary.quasi_static->plate_difference : 0.0;
}

// The plates' forces differ by more than 5 % then, and the kinetic energy of the added mass takes more than a tenth of
// the work: the run ends.
TEST(MassScaling, TurnsASlowCrushIntoADynamicOneWhichEndsByName) {
  SceneSpec spec = slow_specimen();
  EXPECT_LT(difference_of(spec), 0.05);
  spec.numerics.mass_scaling = 1000.0;
  spec.numerics.rotary_scaling = 3.0;
  const stability::WatchedRun crush(spec);
  EXPECT_EQ(crush.status.kind, RunStatus::Kind::inertia) << crush.status.message;
  double impact = 0.0;
  double support = 0.0;
  for (const Sample& sample : crush.samples) {
    impact += sample.stress_impact;
    support += sample.stress_support;
  }
  EXPECT_GT(std::abs(impact - support), 0.05 * 0.5 * (impact + support));
  const SceneFacts facts = facts_of(*scenes::build(spec));
  EXPECT_TRUE(std::any_of(facts.modelled.begin(), facts.modelled.end(), [](const std::string& sentence) {
    return sentence.find("fictitious, 1000 times") != std::string::npos;
  }));
}

// Damping against the ground bears the cells like a thick oil: the impact plate pushes it, the support plate feels
// less.
TEST(MassDamping, HoldsTheCrushUpAndThePlatesTell) {
  SceneSpec spec = slow_specimen();
  spec.numerics.mass_damping_per_s = 1e5;
  const auto held = run(spec);
  ASSERT_TRUE(held.summary.quasi_static);
  EXPECT_GT(held.summary.quasi_static->plate_difference, 0.05);
  EXPECT_GT(held.samples.back().energy_damping(), 0.1 * held.samples.back().energies.external);
}

/// Greatest stress at the impact plate up to 1 % of strain, MPa.
double early_peak(double ramp_strain) {
  SceneSpec spec = slow_specimen();
  spec.loading.speed_m_per_s = 10.0;
  spec.loading.end_strain = 0.02;
  spec.loading.ramp_strain = ramp_strain;
  double peak = 0.0;
  for (const Sample& sample : run(spec).samples) {
    peak = std::max(peak, sample.strain < 0.01 ? sample.stress_impact : 0.0);
  }
  return peak;
}

// A plate that is at its speed at once sends a wave ahead that has nothing to do with the cells' strength.
TEST(SuddenStart, SendsAWaveThatARampOfTheSpeedTakesAway) { EXPECT_GT(early_peak(0.0), 2.0 * early_peak(0.01)); }

// Crushes past the strain at which the cells are full: no metal can follow, and walls are pressed into each other.

stability::WatchedRun compact(double speed, MaterialSpec::Plane plane, double end_strain) {
  SceneSpec spec = scenes::preset("hexagon-small");
  spec.loading.speed_m_per_s = speed;
  spec.loading.end_strain = end_strain;
  spec.material.plane = plane;
  return stability::WatchedRun(spec);
}

// At relative density 0.1 a strain of 0.948 leaves room for half of the metal.
TEST(CrushBeyondSolid, IsWarnedOfAndEndsByNameAndKeepsWhatWasBefore) {
  for (const double speed : {25.0, 100.0}) {
    for (const auto plane : {MaterialSpec::Plane::stress, MaterialSpec::Plane::strain}) {
      const stability::WatchedRun crush = compact(speed, plane, 0.948);
      const Warning* warning = crush.warning_of(Warning::Kind::denser_than_solid);
      ASSERT_NE(warning, nullptr);
      EXPECT_GT(warning->strain, 0.85);
      EXPECT_NE(warning->message.find("mm from the impact end before loading"), std::string::npos) << warning->message;
      scenes::record_bound("densest layer is solid from strain", warning->strain, 0.93);
      EXPECT_TRUE(crush.status.kind == RunStatus::Kind::overcompaction ||
                  crush.status.kind == RunStatus::Kind::energy_balance)
          << crush.status.message;
      EXPECT_NE(crush.status.message.find("strain 0.9"), std::string::npos) << crush.status.message;
      EXPECT_NE(crush.status.remedy.find("loading.end_strain"), std::string::npos) << crush.status.remedy;
      EXPECT_GT(crush.lost_strain, warning->strain);
      ASSERT_FALSE(crush.samples.empty());
      EXPECT_GT(crush.samples.back().strain, warning->strain);
      EXPECT_LE(crush.samples.back().densest_layer.solid_fraction, kMostCompaction);
      // No contact had been pressed past the middle of a wall before the metal was solid.
      for (const Sample& sample : crush.samples) {
        if (sample.strain <= warning->strain) {
          EXPECT_LT(sample.deepest_penetration, 0.5) << sample.strain;
        }
      }
    }
  }
}

TEST(CrushBeyondSolid, IsNotWarnedOfWhereMetalHasRoom) {
  const stability::WatchedRun crush = compact(100.0, MaterialSpec::Plane::stress, 0.8);
  EXPECT_EQ(crush.status.kind, RunStatus::Kind::finished) << crush.status.message;
  EXPECT_EQ(crush.warning_of(Warning::Kind::denser_than_solid), nullptr);
  EXPECT_GT(crush.samples.back().densest_layer.solid_fraction, 0.85);
  scenes::record_bound("densest layer at 80 % strain", crush.samples.back().densest_layer.solid_fraction);
}

}  // namespace
}  // namespace cellcrush
