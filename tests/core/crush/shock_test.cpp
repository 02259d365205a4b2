#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cellcrush/presets.h"
#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/run_frame.h"

namespace cellcrush {
namespace {

/// Strain behind the front that the shock's own part of the plateau stands for: rho* V^2 / (impact - support), Eq. 51 with the
/// support stress as sigma_0. MPa, tonne / mm^3.
double strain_behind_front(double speed_m_per_s) {
  SceneSpec spec = scenes::hexagon_block(30, 10);
  spec.loading.speed_m_per_s = speed_m_per_s;
  spec.loading.end_strain = 0.45;
  spec.numerics.time_step_s = 0.0;
  const auto scene = scenes::build(spec);
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const Summary summary = summarize(*scene, samples);
  const double impact = summary.plateau_stress_impact.value_or(0.0);
  const double support = summary.plateau_stress_support.value_or(0.0);
  const double density = facts_of(*scene).mass / (scene->length * scene->width * scene->depth);
  const double speed = speed_m_per_s * 1e3;
  const double strain = density * speed * speed / (impact - support);
  const std::string name = std::to_string(static_cast<int>(speed_m_per_s));
  testing::Test::RecordProperty("impact_" + name, std::to_string(impact));
  testing::Test::RecordProperty("support_" + name, std::to_string(support));
  testing::Test::RecordProperty("strain_" + name, std::to_string(strain));
  testing::Test::RecordProperty("ledger_" + name, std::to_string(summary.energy_error_relative));
  EXPECT_LT(summary.energy_error_relative, 0.01) << speed_m_per_s << " m/s";
  return strain;
}

TEST(Shock, PlateauGrowsAsTheSquareOfTheSpeedOverTheStrainBehindTheFront) {
  for (const double speed : {100.0, 150.0, 200.0}) {
    const double strain = strain_behind_front(speed);
    EXPECT_GT(strain, 0.80) << speed << " m/s";
    EXPECT_LT(strain, 1.00) << speed << " m/s";
  }
}

}  // namespace
}  // namespace cellcrush
