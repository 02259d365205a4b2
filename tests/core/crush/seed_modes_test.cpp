#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/seeded_crushes.h"

// A crush mode belongs to a lattice and a speed, so it must not depend on which random imperfection the walls have.

namespace cellcrush {
namespace {

constexpr int kSeeds = 10;
constexpr int kAgreeing = 9;
constexpr double kAmplitude = 0.04;  // mm, 1 % of a wall's length

/// 17 rows of 24 and 23 hexagons of Type I.
std::vector<scenes::SeededCrush> crush_seeds(double speed) {
  SceneSpec spec = scenes::hexagon_specimen(24, 17);
  spec.loading.speed_m_per_s = speed;
  spec.loading.end_strain = 0.6;
  spec.output.sample_count = 200;
  return scenes::crush_with_seeds(spec, kAmplitude, kSeeds);
}

TEST(SeedModes, AFastCrushIsLayerByLayerForAtLeastNineOfTenSeeds) {
  const auto crushes = crush_seeds(100.0);
  EXPECT_GE(scenes::count_of(crushes, CrushMode::i), kAgreeing) << scenes::describe(crushes);
  EXPECT_GE(std::ranges::count_if(crushes, [](const auto& crush) { return crush.unevenness < 1.0; }), kAgreeing)
      << scenes::describe(crushes);
  scenes::record_figure("seeds with mode I", static_cast<double>(scenes::count_of(crushes, CrushMode::i)), 2);
  const auto most = std::ranges::max(crushes, {}, &scenes::SeededCrush::unevenness);
  scenes::record_bound("unevenness in cells", most.unevenness);
}

TEST(SeedModes, ASlowCrushIsAVForAtLeastNineOfTenSeeds) {
  const auto crushes = crush_seeds(10.0);
  EXPECT_GE(scenes::count_of(crushes, CrushMode::v), kAgreeing) << scenes::describe(crushes);
  const auto uneven = std::ranges::count_if(crushes, [](const auto& crush) { return crush.unevenness > 1.5; });
  EXPECT_GE(uneven, kAgreeing) << scenes::describe(crushes);
  scenes::record_figure("seeds with mode V", static_cast<double>(scenes::count_of(crushes, CrushMode::v)), 1);
  scenes::record_figure("uneven seeds", static_cast<double>(uneven), 2);
}

}  // namespace
}  // namespace cellcrush
