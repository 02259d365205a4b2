// Joints of the size of their walls (section.rigid_joints): the arms, the mesh, and the modulus of hexagons whose walls
// bend between them. Blind to: how much real joints deform.
#include "scene/rigid_joints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush::rigid_joints {
namespace {

constexpr double kSide = 4.0;

SceneSpec elastic_hexagons(double thickness, bool rigid) {
  SceneSpec spec;
  spec.lattice = scenes::hexagons(8, 7, kSide, thickness, thickness);
  spec.depth_mm = 4.0;
  spec.material.youngs_modulus_mpa = 70000.0;
  spec.material.yield_stress_mpa = 1e5;
  spec.material.density_kg_per_m3 = 2700.0;
  spec.section.rigid_joints = rigid;
  spec.loading.speed_m_per_s = 2.0;
  spec.loading.ramp_strain = 0.002;
  spec.loading.end_strain = 0.01;
  return spec;
}

/// Length of an arm of regular hexagons, mm.
double arm_of(double thickness) { return 0.5 * thickness / std::numbers::sqrt3; }

TEST(RigidJoints, ArmsEndWhereTheFacesMeet) {
  Layout corner;
  corner.joints = {{0.0, 0.0}, {10.0, 0.0}, {0.0, 10.0}, {-10.0, 0.0}};
  corner.walls = {{0, 1, 1.0}, {2, 0, 2.0}, {0, 3, 1.0}};
  const auto arms = arms_of(corner);
  // The wall of 1 mm meets that of 2 mm at 90 degrees after half of its thickness, and lies in line with the other.
  EXPECT_NEAR(arms[0].first, 0.5 * 1.0 / 10.0, 1e-12);
  EXPECT_NEAR(arms[1].second, 0.5 / 10.0, 1e-12);
  EXPECT_EQ(arms[0].second, 0.0);
}

TEST(RigidJoints, WallsOfHexagonsAreFreeBetweenTheirArms) {
  const double thickness = 0.8;
  const auto scene = scenes::build(elastic_hexagons(thickness, true));
  const auto plain = scenes::build(elastic_hexagons(thickness, false));
  double longest = 0.0;
  double shortest = kSide;
  for (const WallBlock& block : scene->walls.blocks) {
    for (int w = block.first_wall; w < block.first_wall + block.walls; ++w) {
      const double length = block.elements * scene->walls.undeformed_length[w];
      longest = std::max(longest, length);
      shortest = std::min(shortest, length);
    }
  }
  EXPECT_NEAR(shortest, kSide - 2.0 * arm_of(thickness), 1e-9);
  EXPECT_LT(longest, kSide);
  EXPECT_NEAR(scene->total_mass / plain->total_mass, 1.0, 1e-12);
  EXPECT_NEAR(scene->solid_area / plain->solid_area, 1.0, 0.01);  // joints at the edges
  EXPECT_EQ(scene->wall_count(), plain->wall_count());
}

/// Stress at the end of an elastic crush, over its strain; mean of its second half, MPa.
double modulus_of(const SceneSpec& spec) {
  double stress = 0.0;
  double strain = 0.0;
  for (const Sample& sample : scenes::run_frame(spec)) {
    if (sample.strain < 0.5 * *spec.loading.end_strain) continue;
    stress += 0.5 * (sample.stress_impact + sample.stress_support);
    strain += sample.strain;
  }
  return stress / strain;
}

/// Compliance of an oblique wall of regular hexagons along the crush, free over a length: by bending and stretching.
double compliance_of(double free_length, double thickness) {
  return 0.25 * std::pow(free_length, 3) / (thickness * thickness) + 0.75 * free_length;
}

/// By how much rigid joints raise the modulus of a specimen.
double rise_of(int columns, int rows, double thickness) {
  SceneSpec rigid = elastic_hexagons(thickness, true);
  SceneSpec plain = elastic_hexagons(thickness, false);
  for (SceneSpec* spec : {&rigid, &plain}) spec->lattice = scenes::hexagons(columns, rows, kSide, thickness, thickness);
  return modulus_of(rigid) / modulus_of(plain);
}

// The edges of a specimen take part as one over its size: two sizes tell the rise without edges.
TEST(RigidJoints, TheModulusOfHexagonsIsThatOfTheirFreeWalls) {
  for (const auto& [slenderness, name] : {std::pair(0.1, "0.1"), std::pair(0.2, "0.2")}) {
    const double thickness = slenderness * kSide;
    const double rise = 2.0 * rise_of(16, 14, thickness) - rise_of(8, 7, thickness);
    const double expected = compliance_of(kSide, thickness) / compliance_of(kSide - 2.0 * arm_of(thickness), thickness);
    scenes::record_figure(std::string("rise over its closed form at h/l ") + name, rise / expected, 2, {1.0, 0.03});
  }
}

TEST(RigidJoints, OfFramesAndSidesThatRepeatAreRefused) {
  SceneSpec spec = elastic_hexagons(0.4, true);
  spec.loading.sides.kind = LoadingSpec::Sides::Kind::periodic;
  EXPECT_THAT(build_scene(spec).problems,
              ::testing::Contains(::testing::Field(&Problem::field, "section.rigid_joints")));
  spec = scenes::elastic_frame(scenes::bar(10.0, 1.0, 2));
  spec.section.rigid_joints = true;
  EXPECT_THAT(build_scene(spec).problems,
              ::testing::Contains(::testing::Field(&Problem::field, "section.rigid_joints")));
}

}  // namespace
}  // namespace cellcrush::rigid_joints
