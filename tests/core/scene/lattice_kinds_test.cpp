// What every kind of lattice keeps, whatever it is: its layout, its closed forms, its ledger, its bits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "core/scene/periodic_cell.h"
#include "geometry/find_parts.h"
#include "lattice/lattice.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

constexpr double kSide = 10.0;
constexpr double kRatio = 0.02;  // of thickness and side

struct OneLattice {
  std::string name;
  RegularLattice lattice;

  friend void PrintTo(const OneLattice& one, std::ostream* out) { *out << one.name; }
};

/// Every kind with its default numbers, and some with others.
std::vector<OneLattice> all_lattices() {
  std::vector<OneLattice> all;
  const auto add = [&](const std::string& name, const std::string& kind, const std::map<std::string, double>& own) {
    all.push_back({name, {kind, 4, 4, kSide, kRatio * kSide, own}});
  };
  for (const LatticeKind* kind : lattice_kinds()) add(std::string(kind->name), std::string(kind->name), {});
  add("hexagon_reentrant", "hexagon", {{"angle_degrees", -30.0}, {"height_mm", 2.0 * kSide}});
  add("hexagon_long", "hexagon", {{"angle_degrees", 45.0}, {"height_mm", 1.5 * kSide}});
  add("hexagon_flat", "hexagon", {{"angle_degrees", 10.0}});
  add("hexagon_expanded", "hexagon", {{"vertical_wall_thickness_mm", 2.0 * kRatio * kSide}});
  add("arrowhead_steep", "arrowhead", {{"long_angle_degrees", 70.0}, {"short_angle_degrees", 20.0}});
  add("anti_tetrachiral_large", "anti_tetrachiral", {{"ring_radius_mm", 0.4 * kSide}});
  add("hierarchical_hexagon_small", "hierarchical_hexagon", {{"small_side_mm", 0.1 * kSide}});
  return all;
}

SceneSpec spec_of(RegularLattice lattice, int cells, LoadingSpec::Direction direction) {
  SceneSpec spec = scenes::hexagon_specimen(4, 4);
  lattice.columns = lattice.rows = cells;
  spec.lattice = std::move(lattice);
  spec.imperfection = {};
  spec.loading.direction = direction;
  spec.elements_per_wall.reset();
  return spec;
}

class EachLattice : public testing::TestWithParam<OneLattice> {
 protected:
  [[nodiscard]] const RegularLattice& lattice() const { return GetParam().lattice; }
  [[nodiscard]] SceneSpec spec(int cells, LoadingSpec::Direction direction) const {
    return spec_of(lattice(), cells, direction);
  }
  [[nodiscard]] const LatticeKind& kind() const { return *kind_of(spec(2, kX)); }

  static constexpr auto kX = LoadingSpec::Direction::x;
  static constexpr auto kY = LoadingSpec::Direction::y;
};

TEST_P(EachLattice, IsOnePartOfWallsThatMeetAtDistinctJoints) {
  for (const int cells : {2, 3, 4}) {
    SceneSpec its = spec(cells, kX);
    its.elements_per_wall = 2;
    const Layout layout = kind().lay_out(its);
    std::vector<int> ends(layout.joints.size(), 0);
    std::set<std::pair<int, int>> pairs;
    for (const LayoutWall& wall : layout.walls) {
      ++ends[wall.start];
      ++ends[wall.end];
      EXPECT_TRUE(pairs.insert(std::minmax(wall.start, wall.end)).second) << "two walls between two joints";
    }
    EXPECT_GE(std::ranges::min(ends), 2) << "a wall ends freely";
    EXPECT_EQ(std::ranges::max(find_parts(layout.joints.size(), layout.walls)), 0) << "parts";
    for (std::size_t i = 0; i < layout.joints.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GT((layout.joints[i] - layout.joints[j]).norm(), 2.0 * kRatio * kSide) << "joints " << i << ", " << j;
      }
    }
  }
}

/// The limit of what changes with the reciprocal of the cells a side.
double limit_of(double of_few, double of_twice_as_many) { return 2.0 * of_twice_as_many - of_few; }

TEST_P(EachLattice, HasTheWallsAndTheDensityOfItsClosedForms) {
  const auto walls_and_density = [&](int cells) {
    SceneSpec its = spec(cells, kX);
    its.elements_per_wall = 8;
    const auto scene = scenes::build(its);
    return std::pair(static_cast<double>(scene->walls.start.size()) / (cells * cells),
                     facts_of(*scene).relative_density);
  };
  const auto few = walls_and_density(8);
  const auto many = walls_and_density(16);
  EXPECT_NEAR(limit_of(few.first, many.first) / kind().walls_per_cell, 1.0, 0.02);
  EXPECT_NEAR(limit_of(few.second, many.second) / kind().closed_forms(lattice(), kX).density, 1.0, 0.01);
}

bool has_curves(const RegularLattice& lattice) {
  return lattice.kind == "sinusoidal_square" || lattice.kind == "anti_tetrachiral";
}

/// Holds closed forms against the unit cell of the walls, at a slenderness.
void expect_moduli(RegularLattice lattice, double ratio) {
  SCOPED_TRACE(ratio);
  lattice.wall_thickness_mm = ratio * kSide;
  if (lattice.own.contains("vertical_wall_thickness_mm"))
    lattice.own["vertical_wall_thickness_mm"] = 2.0 * ratio * kSide;
  SceneSpec spec = spec_of(lattice, 8, LoadingSpec::Direction::x);
  spec.elements_per_wall = has_curves(lattice) ? 32 : 1;  // in straight pieces
  const UnitCell cell = find_unit_cell(*scenes::build(spec));
  for (const auto direction : {LoadingSpec::Direction::x, LoadingSpec::Direction::y}) {
    const ClosedForms forms = kind_of(spec)->closed_forms(lattice, direction);
    const auto solved = solve_periodic_cell(cell, direction == LoadingSpec::Direction::x ? 0 : 1);
    scenes::record_bound("E*", solved.modulus / forms.modulus - 1.0, 2e-3);
    scenes::record_bound("nu", solved.poissons_ratio - forms.poissons_ratio, 2e-3);
  }
}

TEST_P(EachLattice, HasTheElasticModuliOfItsClosedForms) {
  for (const double ratio : {0.005, 0.05}) expect_moduli(lattice(), ratio);
}

TEST_P(EachLattice, HasTheCollapseStressOfItsClosedForms) {
  SceneSpec its = spec(8, kX);
  std::get<RegularLattice>(its.lattice).wall_thickness_mm = 0.005 * kSide;
  if (lattice().own.contains("vertical_wall_thickness_mm"))
    std::get<RegularLattice>(its.lattice).own["vertical_wall_thickness_mm"] = 0.01 * kSide;
  its.elements_per_wall = has_curves(lattice()) ? 8 : 1;
  const UnitCell cell = find_unit_cell(*scenes::build(its));
  for (const auto direction : {kX, kY}) {
    const ClosedForms forms = kind().closed_forms(*regular_lattice_of(its), direction);
    if (!forms.collapse_stress) continue;
    const double solved = collapse_stress_of_periodic_cell(cell, direction == kX ? 0 : 1);
    scenes::record_bound("collapse stress", solved / *forms.collapse_stress - 1.0, 0.01);
  }
}

TEST_P(EachLattice, ClosesItsLedgerInAShortCrush) {
  for (const auto direction : {kX, kY}) {
    SceneSpec its = spec(3, direction);
    std::get<RegularLattice>(its.lattice).wall_thickness_mm = 0.05 * kSide;
    its.loading.speed_m_per_s = 50.0;
    its.loading.end_strain = 0.1;
    Simulation simulation(scenes::build(its));
    const std::vector<Sample> samples = scenes::run_to_end(simulation);
    EXPECT_GT(samples.back().energies.plastic, 0.0);
    const Energies& energies = samples.back().energies;
    scenes::record_bound("residual in %", 100.0 * energies.residual / energies.external, 1.0);
  }
}

TEST_P(EachLattice, HasTheBitsOfTheNetworkOfItsWalls) {
  if (lattice().kind == "sinusoidal_square") GTEST_SKIP() << "a network has straight walls and arcs";
  SceneSpec its = spec(3, kY);
  its.imperfection = {.amplitude_mm = 0.01, .seed = 5, .bow_mm = 0.01};
  its.elements_per_wall = 4;
  its.numerics.time_step_s = 0.5 * scenes::build(its)->schedule.time_step;
  const auto hash_of = [](const SceneSpec& given) {
    Simulation simulation(scenes::build(given));
    simulation.advance(300);
    return scenes::hash_of(simulation.state());
  };
  EXPECT_EQ(hash_of(scenes::as_network(its)), hash_of(its));
}

INSTANTIATE_TEST_SUITE_P(Of, EachLattice, testing::ValuesIn(all_lattices()),
                         [](const auto& one) { return one.param.name; });

/// The fields of the problems of a lattice of sides of 10 mm and walls of 0.2 mm.
std::vector<std::string> faulty_fields(const std::string& kind, const std::map<std::string, double>& own,
                                       int elements = 2, double bow = 0.0) {
  SceneSpec spec = spec_of({kind, 4, 4, kSide, kRatio * kSide, own}, 4, LoadingSpec::Direction::x);
  spec.elements_per_wall = elements;
  spec.imperfection.bow_mm = bow;
  std::vector<std::string> fields;
  for (const Problem& problem : build_scene(spec).problems) fields.push_back(problem.field);
  return fields;
}

TEST(OwnNumbers, AreRefusedBeyondTheirLimitsAndWhereTheyDoNotFit) {
  using ::testing::ElementsAre;
  using ::testing::IsEmpty;
  EXPECT_THAT(faulty_fields("hexagon", {{"angle_degrees", 76.0}}), ElementsAre("lattice.hexagon.angle_degrees"));
  EXPECT_THAT(faulty_fields("hexagon", {{"angle_degrees", -30.0}}), ElementsAre("lattice.hexagon.angle_degrees"))
      << "walls of height_mm 10 let the corners of a cell meet";
  EXPECT_THAT(faulty_fields("hexagon", {{"angle_degrees", -30.0}, {"height_mm", 10.3}}), IsEmpty());
  EXPECT_THAT(faulty_fields("hexagon", {{"height_mm", 0.39}}), ElementsAre("lattice.hexagon.wall_thickness_mm"))
      << "half of a wall along y is 0.195 mm";
  EXPECT_THAT(faulty_fields("hexagon", {{"height_mm", 1.0}}, 2, 0.06), ElementsAre("lattice.imperfection.bow_mm"))
      << "a twentieth of the shortest wall";
  EXPECT_THAT(faulty_fields("arrowhead", {{"long_angle_degrees", 40.0}, {"short_angle_degrees", 39.5}}),
              ElementsAre("lattice.arrowhead.short_angle_degrees"));
  EXPECT_THAT(faulty_fields("hierarchical_hexagon", {{"small_side_mm", 5.0}}),
              ElementsAre("lattice.hierarchical_hexagon.small_side_mm"));
  EXPECT_THAT(faulty_fields("sinusoidal_square", {{"amplitude_mm", 0.0}}),
              ElementsAre("lattice.sinusoidal_square.amplitude_mm"));
  EXPECT_THAT(faulty_fields("sinusoidal_square", {}, 1), ElementsAre("elements_per_wall"));
  EXPECT_THAT(faulty_fields("anti_tetrachiral", {}, 3), ElementsAre("elements_per_wall"));
  EXPECT_THAT(faulty_fields("anti_tetrachiral", {}, 4), IsEmpty());
  EXPECT_THAT(faulty_fields("anti_tetrachiral", {{"ring_radius_mm", 4.8}}, 4), IsEmpty());
  EXPECT_THAT(faulty_fields("anti_tetrachiral", {{"ring_radius_mm", 4.9}}, 4),
              ElementsAre("lattice.anti_tetrachiral.ring_radius_mm"))
      << "walls of 0.2 mm";
}

}  // namespace
}  // namespace cellcrush
