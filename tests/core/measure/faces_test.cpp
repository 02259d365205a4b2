#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>

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

Lattice trace(const char* kind, int columns, int rows, int elements_per_wall, double imperfection = 0.0) {
  SceneSpec spec = scenes::preset("hexagon-small");
  spec.lattice = RegularLattice{kind, columns, rows, 4.0, 0.2, {}};
  spec.elements_per_wall = elements_per_wall;
  spec.imperfection = {imperfection, 7};
  const auto scene = scenes::build(spec);
  return {scene, trace_faces(scene->position, scene->elements)};
}

// Euler: faces = edges - vertices + 1 without the outer one.
TEST(Faces, AreTheCells) {
  struct Kind {
    const char* name;
    int columns, rows, elements;
    std::size_t cells;
    double area;  // mm^2
  };
  constexpr double kHexagon = 1.5 * std::numbers::sqrt3 * 16.0;
  for (const auto& [name, columns, rows, elements, cells, each] :
       {Kind{"hexagon", 7, 4, 1, 26, kHexagon}, Kind{"hexagon", 7, 4, 2, 26, kHexagon},
        Kind{"hexagon", 7, 4, 3, 26, kHexagon}, Kind{"square", 6, 5, 2, 30, 16.0},
        Kind{"triangle", 6, 4, 2, 44, 0.25 * std::numbers::sqrt3 * 16.0}}) {
    const auto [scene, faces] = trace(name, columns, rows, elements);
    EXPECT_EQ(faces.count(), cells) << name << elements;
    EXPECT_EQ(faces.count(), scene->element_count() - scene->particle_count() + 1);
    double worst = 0.0;
    for (const double area : faces.area) worst = std::max(worst, std::abs(area / each - 1.0));
    scenes::record_bound(std::string(name) + "s", worst, 1e-9);
  }
  EXPECT_EQ(trace("hexagon", 9, 6, 2, 0.2).faces.count(), 3u * 9u + 3u * 8u) << "imperfect";
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

/// A specimen of cells a unit apart, rows shifted by half a cell in turn as hexagons are.
CollapseField specimen(int columns, int rows, const std::function<bool(double, double)>& collapsed) {
  CollapseField field;
  field.length = columns;
  field.width = rows * std::sqrt(0.75);
  field.pitch = 1.0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns - row % 2; ++column) {
      field.along.push_back(column + 0.5 + 0.5 * (row % 2));
      field.across.push_back((row + 0.5) * std::sqrt(0.75));
      field.collapsed.push_back(collapsed(field.along.back(), field.across.back()));
    }
  }
  return field;
}

/// Turns a share of the flags over, the same ones each time.
CollapseField with_noise(CollapseField field, double share) {
  std::mt19937_64 generator(20261121);
  for (auto&& flag : field.collapsed) {
    if (static_cast<double>(generator() >> 11) * 0x1p-53 < share) {
      flag.flip();
    }
  }
  return field;
}

/// A field of one kind, as a function of the place within a specimen of this length and width.
struct Drawn {
  CrushMode mode;
  const char* name;
  std::function<bool(double s, double t, double length, double width)> collapsed;
};

bool is_bow(double s, double t, double length, double width, double hand) {
  const double r = (t - 0.5 * width) / (0.5 * width);
  return std::abs(s - 0.5 * length - hand * (0.45 * width * r * r - 0.2 * width)) < 1.0;
}

const Drawn kDrawn[] = {
    {CrushMode::i, "front", [](double s, double, double length, double) { return s < 0.15 * length; }},
    {CrushMode::i, "band", [](double s, double, double length, double) { return std::abs(s - 0.5 * length) < 2.0; }},
    {CrushMode::i, "bands at both ends",
     [](double s, double, double length, double) { return s < 2.5 || s > length - 2.5; }},
    {CrushMode::v, "V with its point at the impact end",
     [](double s, double t, double, double width) { return std::abs(s - 0.7 * std::abs(t - 0.5 * width)) < 1.5; }},
    {CrushMode::v, "V that opens to the impact end",
     [](double s, double t, double, double width) {
       return std::abs(s - 0.5 * width + 0.7 * std::abs(t - 0.5 * width)) < 1.5;
     }},
    {CrushMode::v, "V with its point on a side",
     [](double s, double t, double length, double) { return std::abs(std::abs(s - 0.5 * length) - 0.5 * t) < 1.5; }},
    {CrushMode::v, "V at either end",
     [](double s, double t, double length, double width) {
       const double arm = 0.6 * std::abs(t - 0.5 * width);
       return std::abs(s - arm) < 1.2 || std::abs(length - s - arm) < 1.2;
     }},
    {CrushMode::x, "X in the middle",
     [](double s, double t, double length, double width) {
       return std::abs(std::abs(s - 0.5 * length) - 0.6 * std::abs(t - 0.5 * width)) < 1.2;
     }},
    {CrushMode::c, "bow", [](double s, double t, double l, double w) { return is_bow(s, t, l, w, 1.0); }},
    {CrushMode::c, "bow to the other side",
     [](double s, double t, double l, double w) { return is_bow(s, t, l, w, -1.0); }},
};

// Seen from either end, and with noise.
TEST(CrushMode, IsThatOfTheBandsThatAreDrawn) {
  for (const auto& [mode, name, collapsed] : kDrawn) {
    for (const auto& [columns, rows] : {std::pair(74, 21), {24, 17}, {20, 40}, {30, 31}}) {
      const double width = rows * std::sqrt(0.75);
      const CollapseField field =
          specimen(columns, rows, [&](double s, double t) { return collapsed(s, t, columns, width); });
      CollapseField turned_round = field;
      for (double& along : turned_round.along) along = field.length - along;
      for (const CollapseField& seen : {field, turned_round, with_noise(field, 0.02)}) {
        EXPECT_EQ(find_crush_mode(seen), mode) << name << " of " << columns << " x " << rows;
      }
    }
  }
}

TEST(CrushMode, CellsThatCollapseAnywhereAndASingleObliqueBandAreMixed) {
  for (const double share : {0.1, 0.2, 0.25}) {
    const CollapseField field = with_noise(specimen(74, 21, [](double, double) { return false; }), share);
    EXPECT_EQ(find_crush_mode(field), CrushMode::mixed) << share;
  }
  const CollapseField field = specimen(30, 31, [](double s, double t) { return std::abs(s - 2.0 - t) < 1.5; });
  EXPECT_EQ(find_crush_mode(field), CrushMode::mixed);
}

TEST(CrushMode, AWholeLatticeHasNone) {
  EXPECT_EQ(find_crush_mode(specimen(20, 10, [](double, double) { return false; })), CrushMode::none);
  // Rows of 20 and 19 cells, of which 5 and 4 have collapsed.
  EXPECT_EQ(collapsed_fraction_of(specimen(20, 10, [](double s, double) { return s < 5.0; })), 9.0 / 39.0);
}

}  // namespace
}  // namespace cellcrush
