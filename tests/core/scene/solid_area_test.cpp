// Where a lattice between plates is closed: the area of its walls with joints counted once, the strain that follows,
// and what a run says and does there.
#include "scene/solid_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cellcrush/simulation.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/rigid_walls.h"

namespace cellcrush {
namespace {

/// Area that the strips of all elements cover, from a grid of points.
double covered_area(const Scene& scene) {
  constexpr double kPitch = 0.02;
  Vector2 low = scene.position.front();
  Vector2 high = low;
  for (const Vector2& place : scene.position) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const double margin = scene.largest_radius;
  const auto columns = static_cast<int>((high.x() - low.x() + 2.0 * margin) / kPitch);
  const auto rows = static_cast<int>((high.y() - low.y() + 2.0 * margin) / kPitch);
  std::vector<bool> covered(static_cast<std::size_t>(columns) * rows);
  for (const Element& element : scene.elements) {
    const Vector2 start = scene.position[element.start];
    const Vector2 along = scene.position[element.end] - start;
    const double length = along.norm();
    const Vector2 axis = along / length;
    const auto column_of = [&](double x) {
      return std::clamp(static_cast<int>((x - low.x() + margin) / kPitch), 0, columns - 1);
    };
    const auto row_of = [&](double y) {
      return std::clamp(static_cast<int>((y - low.y() + margin) / kPitch), 0, rows - 1);
    };
    const Vector2 end = scene.position[element.end];
    for (int i = column_of(std::min(start.x(), end.x()) - margin);
         i <= column_of(std::max(start.x(), end.x()) + margin); ++i) {
      for (int j = row_of(std::min(start.y(), end.y()) - margin); j <= row_of(std::max(start.y(), end.y()) + margin);
           ++j) {
        const Vector2 offset = low + Vector2((i + 0.5) * kPitch - margin, (j + 0.5) * kPitch - margin) - start;
        const double forward = axis.dot(offset);
        const double aside = std::abs(axis.x() * offset.y() - axis.y() * offset.x());
        if (forward >= 0.0 && forward <= length && aside <= 0.5 * element.thickness)
          covered[static_cast<std::size_t>(i) * rows + j] = true;
      }
    }
  }
  return kPitch * kPitch * static_cast<double>(std::ranges::count(covered, true));
}

SceneSpec specimen_of(const RegularLattice& lattice) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  spec.lattice = lattice;
  spec.imperfection = {0.1, 3};
  spec.elements_per_wall = 2;
  return spec;
}

TEST(SolidArea, IsThatWhichTheWallsCover) {
  for (const double thickness : {0.2, 0.8}) {
    for (const RegularLattice& lattice :
         {scenes::hexagons(4, 3, 4.0, thickness, 2.0 * thickness), scenes::squares(4, 3, 4.0, thickness),
          scenes::triangles(4, 4, 4.0, thickness)}) {
      const auto scene = scenes::build(specimen_of(lattice));
      EXPECT_NEAR(scene->solid_area / covered_area(*scene), 1.0, 0.005) << thickness;
    }
  }
}

TEST(SolidArea, IsThatOfAnyMesh) {
  SceneSpec spec = specimen_of(scenes::triangles(4, 4, 4.0, 0.8));
  spec.imperfection = {};
  const double area = scenes::build(spec)->solid_area;
  spec.elements_per_wall = 16;  // shorter than the walls overlap at joints
  EXPECT_NEAR(scenes::build(spec)->solid_area / area, 1.0, 1e-9);
}

TEST(SolidArea, CellsOfRigidBodiesAreSolid) {
  SceneSpec spec = scenes::hexagon_specimen(6, 5);
  spec.inclusions.rows = {2};
  const auto scene = scenes::build(spec);
  const double thickness = scene->elements[scene->rigid.first_element].thickness;
  const double inradius = 0.5 * (std::sqrt(3.0) * *std::get<RegularLattice>(spec.lattice).side_mm - thickness);
  const double voids = 5 * 2.0 * std::sqrt(3.0) * inradius * inradius;
  EXPECT_NEAR(scene->solid_area / (covered_area(*scene) + voids), 1.0, 0.005);
}

/// Hexagons of h/L = 0.2 at 100 m/s, which close at about 0.72.
SceneSpec thick_hexagons() {
  SceneSpec spec = scenes::spec_of({"hexagon", 100.0, 0.0}, 4, 3);
  spec.lattice = scenes::hexagons(4, 3, 4.0, 0.8, 0.8);
  spec.loading.end_strain.reset();
  return spec;
}

TEST(Closing, EndsARunByDefault) {
  const auto scene = scenes::build(thick_hexagons());
  Simulation simulation(scene);
  const std::vector<Sample> samples = scenes::run_to_end(simulation);
  const Summary summary = summarize(*scene, samples);
  ASSERT_TRUE(summary.valid_to_strain);
  EXPECT_NEAR(*summary.valid_to_strain, 1.0 - scene->solid_area / (0.75 * scene->length * scene->width), 1e-12);
  EXPECT_EQ(summary.end, RunEnd::closed);
  EXPECT_NEAR(samples.back().strain, *summary.valid_to_strain, 1e-3);
  EXPECT_NEAR(samples.back().solid_fraction, kClosed, 0.01);
  EXPECT_TRUE(std::ranges::none_of(summary.warnings,
                                   [](const Warning& warning) { return warning.kind == Warning::Kind::closed; }));
  EXPECT_NEAR(*complete_spec(thick_hexagons(), *scene).loading.end_strain, *summary.valid_to_strain, 1e-12);
}

TEST(Closing, OfARunThatGoesOnIsAWarningAndResultsAreThoseBefore) {
  SceneSpec spec = thick_hexagons();
  const auto scene = scenes::build(spec);
  std::vector<Sample> samples;
  for (int i = 1; i <= 800; ++i) {
    Sample sample;
    sample.strain = 0.001 * i;
    sample.stress_impact = sample.stress_support = sample.strain < *closing_strain_of(*scene) ? 1.0 : 1000.0;
    samples.push_back(sample);
  }
  const Summary summary = summarize(*scene, samples);
  EXPECT_NEAR(*summary.plateau_stress_impact, 1.0, 1e-12);
  EXPECT_FALSE(summary.densification_strain) << "the rise comes after the lattice is closed";
  spec.loading.end_strain = *summary.valid_to_strain + 0.01;
  const auto longer = scenes::build(spec);
  Simulation beyond(longer);
  const Summary of_beyond = summarize(*longer, scenes::run_to_end(beyond));
  EXPECT_EQ(of_beyond.end, RunEnd::strain);
  EXPECT_EQ(std::ranges::count(of_beyond.warnings, Warning::Kind::closed, &Warning::kind), 1);
}

TEST(Closing, OfAFrameBetweenRigidWallsIsAWarningWithItsTime) {
  SceneSpec spec = scenes::struck_hexagons(1e6, 100.0);
  spec.loads.rigid_walls.push_back({0.0, -0.5001 * *scenes::cells_of(spec).wall_thickness_mm, 0.0, 1.0});
  spec.loading.end_time_s = 1.85e-4;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  const std::vector<Sample> samples = scenes::run_to_end(simulation);
  const Summary summary = summarize(*scene, samples);
  EXPECT_NEAR(samples.front().solid_fraction, scene->solid_area / (scene->length * scene->width), 0.1);
  EXPECT_GT(samples.back().solid_fraction, kClosed);
  ASSERT_TRUE(summary.valid_to_time);
  const auto closed = std::ranges::find_if(samples, [](const Sample& now) { return now.solid_fraction > kClosed; });
  EXPECT_NEAR(*summary.valid_to_time, closed->time, 1e-12);
  EXPECT_FALSE(summary.valid_to_strain);
}

}  // namespace
}  // namespace cellcrush
