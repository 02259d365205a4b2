#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "measure/crush_mode.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

struct Lattice {
  std::shared_ptr<Scene> scene;
  Faces faces;
};

Lattice trace(const char* kind, int columns, int rows, int elements_per_wall) {
  SceneSpec spec = scenes::preset("hexagon-small");
  spec.lattice = RegularLattice{kind, columns, rows, 4.0, 0.2, {}};
  spec.elements_per_wall = elements_per_wall;
  spec.numerics.time_step_s = 0.0;
  Lattice lattice;
  lattice.scene = scenes::build(spec);
  lattice.faces = trace_faces(lattice.scene->position, lattice.scene->elements);
  return lattice;
}

/// Euler: faces = edges - vertices + 1 without the outer one.
void expect_euler(const Lattice& lattice) {
  EXPECT_EQ(lattice.faces.count(), lattice.scene->element_count() - lattice.scene->particle_count() + 1);
}

void expect_areas(const Lattice& lattice, double each, const std::string& cells) {
  double worst = 0.0;
  for (const double area : lattice.faces.area) {
    EXPECT_NEAR(area, each, 1e-9 * each);
    worst = std::max(worst, std::abs(area / each - 1.0));
  }
  scenes::record_bound(cells, worst);
}

TEST(Faces, OfHexagonsAreTheCells) {
  for (const int elements : {1, 2, 3}) {
    const Lattice lattice = trace("hexagon", 7, 4, elements);
    EXPECT_EQ(lattice.faces.count(), 7u + 6u + 7u + 6u);
    expect_euler(lattice);
    expect_areas(lattice, 1.5 * std::numbers::sqrt3 * 16.0, "hexagons");
  }
}

TEST(Faces, OfSquaresAreTheCells) {
  const Lattice lattice = trace("square", 6, 5, 2);
  EXPECT_EQ(lattice.faces.count(), 30u);
  expect_euler(lattice);
  expect_areas(lattice, 16.0, "squares");
  const double whole = std::accumulate(lattice.faces.area.begin(), lattice.faces.area.end(), 0.0);
  EXPECT_NEAR(whole, 6 * 5 * 16.0, 1e-9);
}

TEST(Faces, OfTrianglesAreTheCells) {
  const Lattice lattice = trace("triangle", 6, 4, 2);
  EXPECT_EQ(lattice.faces.count(), 4u * 11u);
  expect_euler(lattice);
  expect_areas(lattice, 0.25 * std::numbers::sqrt3 * 16.0, "triangles");
}

TEST(Faces, OfAnImperfectLatticeAreTheSameCells) {
  SceneSpec spec = scenes::hexagon_specimen(9, 6);
  spec.imperfection = {0.2, 7};
  spec.numerics.time_step_s = 0.0;
  const auto scene = scenes::build(spec);
  EXPECT_EQ(trace_faces(scene->position, scene->elements).count(), 3u * 9u + 3u * 8u);
}

TEST(Faces, ADanglingElementBelongsToTheFaceAroundIt) {
  const std::vector<Vector2> position = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {3, 3}};
  std::vector<Element> elements(6);
  const int ends[6][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {2, 5}};
  for (int i = 0; i < 6; ++i) {
    elements[i].start = ends[i][0];
    elements[i].end = ends[i][1];
  }
  const Faces faces = trace_faces(position, elements);
  ASSERT_EQ(faces.count(), 1u);
  EXPECT_NEAR(faces.area[0], 4.0, 1e-12);
}

TEST(Faces, AreasFollowTheParticles) {
  const Lattice lattice = trace("hexagon", 5, 3, 2);
  std::vector<Vector2> squeezed = lattice.scene->position;
  for (Vector2& position : squeezed) {
    position = {0.3 * position.x() + 0.2 * position.y(), position.y()};
  }
  for (const double ratio : area_ratios(lattice.faces, squeezed)) {
    EXPECT_NEAR(ratio, 0.3, 1e-12);
  }
}

}  // namespace
}  // namespace cellcrush
