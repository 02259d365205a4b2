// Crushes past the strain at which the cells are full: no metal can follow, and walls are pressed into each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/presets.h"
#include "step/check_run.h"

namespace cellcrush {
namespace {

struct Compaction {
  RunStatus status;
  std::vector<Sample> samples;  ///< that passed the check
  double lost_strain = 0.0;     ///< of the one that did not
  std::vector<Warning> warnings;

  Compaction(double speed, MaterialSpec::Plane plane, double end_strain) {
    SceneSpec spec = scenes::preset("hexagon-small");
    spec.loading.speed_m_per_s = speed;
    spec.loading.end_strain = end_strain;
    spec.material.plane = plane;
    Simulation simulation(scenes::build(spec));
    while (simulation.status().kind == RunStatus::Kind::running) {
      simulation.advance(simulation.scene().schedule.sample_interval);
      const Sample sample = simulation.take_sample();
      const RunStatus::Kind kind = simulation.status().kind;
      if (kind == RunStatus::Kind::running || kind == RunStatus::Kind::finished) {
        samples.push_back(sample);
      } else {
        lost_strain = sample.strain;
      }
    }
    status = simulation.status();
    warnings = summarize(simulation.scene(), samples).warnings;
  }

  [[nodiscard]] const Warning* of(Warning::Kind kind) const {
    const auto found = std::ranges::find(warnings, kind, &Warning::kind);
    return found == warnings.end() ? nullptr : &*found;
  }
};

// At relative density 0.1 a strain of 0.948 leaves room for half of the metal.
TEST(CrushBeyondSolid, IsWarnedOfAndEndsByNameAndKeepsWhatWasBefore) {
  for (const double speed : {25.0, 100.0}) {
    for (const auto plane : {MaterialSpec::Plane::stress, MaterialSpec::Plane::strain}) {
      const Compaction crush(speed, plane, 0.948);
      const Warning* warning = crush.of(Warning::Kind::denser_than_solid);
      ASSERT_NE(warning, nullptr);
      EXPECT_GT(warning->strain, 0.85);
      EXPECT_LT(warning->strain, 0.93);
      EXPECT_NE(warning->message.find("mm from the impact end before loading"), std::string::npos) << warning->message;
      scenes::record_bound("densest layer is solid from strain", warning->strain);
      EXPECT_EQ(crush.status.kind, RunStatus::Kind::overcompaction) << crush.status.message;
      EXPECT_NE(crush.status.message.find("strain 0.9"), std::string::npos) << crush.status.message;
      EXPECT_NE(crush.status.remedy.find("loading.end_strain"), std::string::npos) << crush.status.remedy;
      EXPECT_GT(crush.lost_strain, warning->strain);
      ASSERT_FALSE(crush.samples.empty());
      EXPECT_GT(crush.samples.back().strain, warning->strain);
      EXPECT_LE(crush.samples.back().densest_layer.solid_fraction, kMostCompaction);
      // No contact had been pressed past the middle of a wall before.
      EXPECT_LT(crush.samples.back().deepest_penetration, 0.5);
    }
  }
}

TEST(CrushBeyondSolid, IsNotWarnedOfWhereMetalHasRoom) {
  const Compaction crush(100.0, MaterialSpec::Plane::stress, 0.8);
  EXPECT_EQ(crush.status.kind, RunStatus::Kind::finished) << crush.status.message;
  EXPECT_EQ(crush.of(Warning::Kind::denser_than_solid), nullptr);
  EXPECT_GT(crush.samples.back().densest_layer.solid_fraction, 0.85);
  scenes::record_bound("densest layer at 80 % strain", crush.samples.back().densest_layer.solid_fraction);
}

}  // namespace
}  // namespace cellcrush
