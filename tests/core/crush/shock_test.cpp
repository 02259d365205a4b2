#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cellcrush/simulation.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/run_frame.h"

namespace cellcrush {
namespace {

/// What a specimen of Type I is crushed with, MPa.
struct Plateau {
  double speed = 0.0;    // mm / s
  double shock = 0.0;    // impact minus support stress, the shock's own part
  double density = 0.0;  // rho*, tonne / mm^3

  /// Strain behind the front by Eq. 51 with the support stress as sigma_0: rho* V^2 / (impact - support).
  [[nodiscard]] double strain_behind_front() const { return density * speed * speed / shock; }
};

Plateau crush_specimen(double speed_m_per_s) {
  SceneSpec spec = scenes::hexagon_specimen(30, 10);
  spec.loading.speed_m_per_s = speed_m_per_s;
  spec.loading.end_strain = 0.45;
  spec.numerics.time_step_s = 0.0;
  const auto scene = scenes::build(spec);
  const Summary summary = summarize(*scene, scenes::run_frame(spec));
  const double impact = summary.plateau_stress_impact.value_or(0.0);
  const double support = summary.plateau_stress_support.value_or(0.0);
  EXPECT_LT(summary.energy_error_relative, 0.01) << speed_m_per_s << " m/s";
  return {speed_m_per_s * 1e3, impact - support, facts_of(*scene).mass / (scene->length * scene->width * scene->depth)};
}

TEST(Shock, PlateauGrowsAsTheSquareOfTheSpeedOverTheStrainBehindTheFront) {
  std::vector<Plateau> plateaus;
  for (const double speed : {100.0, 150.0, 200.0}) {
    plateaus.push_back(crush_specimen(speed));
    const double strain = plateaus.back().strain_behind_front();
    // 1 - rho* = 0.9 is a solid without gaps behind a steady front; a specimen this short is not wholly that.
    EXPECT_GT(strain, 0.80) << speed << " m/s";
    EXPECT_LT(strain, 1.00) << speed << " m/s";
  }
  const Plateau& slow = plateaus.front();
  const Plateau& fast = plateaus.back();
  const double slope_strain =
      slow.density * (fast.speed * fast.speed - slow.speed * slow.speed) / (fast.shock - slow.shock);
  const double power = std::log(fast.shock / slow.shock) / std::log(fast.speed / slow.speed);
  scenes::record_figure("densified strain", slope_strain, 2);
  scenes::record_figure("exponent", power, 2);
  EXPECT_GT(slope_strain, 0.80);
  EXPECT_LT(slope_strain, 1.00);
  EXPECT_NEAR(power, 2.0, 0.15);
}

}  // namespace
}  // namespace cellcrush
