// What a run says of itself: every shortcut with its reason, what was asked for as such, and the mesh by its fidelity.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "cellcrush/fidelity.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "scenes/rigid_walls.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Fidelity = NumericsSpec::Fidelity;

std::vector<std::string> said_of(const SceneSpec& spec) { return facts_of(*scenes::build(spec)).modelled; }

// As in `check` and result.h5.
TEST(WhatIsModelled, SaysWhyEachShortcutIsTaken) {
  const auto said = said_of(scenes::hexagon_specimen(4, 3));
  EXPECT_THAT(said, Contains(HasSubstr("by the faces of the lattice: it is connected, planar and closed")));
  EXPECT_THAT(said, Contains(HasSubstr("perfectly plastic; each stores only its stress")));
  EXPECT_THAT(said, Contains(HasSubstr("in single precision, which halves the memory")));
  EXPECT_THAT(said, Contains(HasSubstr("Plates: rigid, unilateral, not meshed")));
  EXPECT_THAT(said, Contains(HasSubstr("Symmetry: not used")));
  EXPECT_THAT(said, Not(Contains(HasSubstr("as requested"))));
  EXPECT_THAT(said_of(scenes::TossedFrame::spec(0.0)),
              Contains(HasSubstr("Rigid walls: 1 half plane, 1 of them moving")));
}

TEST(WhatIsModelled, SaysWhatWasAskedFor) {
  SceneSpec spec = scenes::in_double_precision(scenes::hexagon_specimen(4, 3));
  spec.contact.search = ContactSpec::Search::buckets;
  spec.numerics.time_step_s = 1e-8;
  spec.material.hardening_modulus_mpa = 1000.0;
  const auto said = said_of(spec);
  EXPECT_THAT(said, Contains("Contacts are searched by buckets in space, as requested (contact.search)."));
  EXPECT_THAT(said, Contains("Step: as requested (numerics.time_step_s)."));
  EXPECT_THAT(said,
              Contains(HasSubstr("each stores its back stress and accumulated plastic strain, in double precision")));
}

TEST(WhatIsModelled, SaysWhetherWallsShearAndCoupleBendingWithStretching) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  EXPECT_THAT(said_of(spec), Contains(HasSubstr("Walls: Euler beams")));
  spec.section.shear_deformation = true;
  EXPECT_THAT(said_of(spec), Contains(HasSubstr("Walls: Timoshenko beams of constant section, large rotation, that "
                                                "shear elastically with a shear factor of 0.83")));
  spec.section.coupled_bending = true;
  EXPECT_THAT(said_of(spec), Contains(HasSubstr("bending coupled with stretching")));
}

TEST(WhatIsModelled, SaysThatSlowLoadingNeedsDoublePrecision) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  const auto said = Contains(HasSubstr("rounding errors of slow loading add up"));
  spec.loading.speed_m_per_s = 0.1;
  EXPECT_THAT(said_of(spec), Not(said));
  spec.loading.speed_m_per_s = 0.001;
  EXPECT_THAT(said_of(spec), said);
}

// A formulation that is changed alone keeps the points of the other.
TEST(WhatIsModelled, WarnsOfPointsThatAreComputedOneByOne) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  const auto warning = Contains(HasSubstr("these are computed one element at a time"));
  EXPECT_THAT(said_of(spec), Not(warning));
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  spec.section.axial_points = 4;
  EXPECT_THAT(said_of(spec), warning);
  spec.section.axial_points = 2;
  EXPECT_THAT(said_of(spec), Not(warning));
}

TEST(WhatIsModelled, NamesTheBoundOfTheStep) {
  const auto expect_step = [](const char* preset, double speed, const char* bound) {
    SceneSpec spec = scenes::preset(preset);
    spec.loading.speed_m_per_s = speed;
    EXPECT_THAT(said_of(spec), Contains(testing::AllOf(testing::StartsWith("Step: "), HasSubstr(bound))));
  };
  expect_step("type-i", 10.0, "lightest, stiffest element");
  expect_step("type-i", 400.0, "plate moves by 0.09");
  expect_step("type-iii-as-counted", 10.0, "stacked along the crush");
}

TEST(Fidelity, WithoutOneTheMeshIsTheLatticesStandard) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 2);
  EXPECT_EQ(describe_fidelity(spec), "Mesh: elements_per_wall is 2, STANDARD for hexagons.");
  for (const char* preset : {"type-ii-as-counted", "type-iii-as-counted"}) {
    spec = scenes::preset(preset);
    EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 16) << preset;
    EXPECT_THAT(describe_fidelity(spec),
                HasSubstr("is 16, STANDARD for " + scenes::cells_of(spec).kind + "s, whose walls"));
    spec.section.formulation = SectionSpec::Formulation::displacement_based;
    EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 2) << "the paper's elements keep the paper's mesh";
    EXPECT_THAT(describe_fidelity(spec), HasSubstr("not known"));
  }
  const SceneSpec frame = scenes::Cantilever::spec(4, FrameLattice::Component::y, 1.0, 0.1, 0.2);
  EXPECT_EQ(fill_in_fidelity(frame).elements_per_wall, 2);
  EXPECT_EQ(describe_fidelity(frame), "");
}

TEST(Fidelity, EveryLatticeHasACoarserAndAFinerMesh) {
  const auto expect_meshes = [](const SceneSpec& spec, const std::vector<int>& expected) {
    std::vector<int> meshes;
    for (const FidelityPoint& point : fidelity_points(spec)) meshes.push_back(point.elements_per_wall);
    EXPECT_EQ(meshes, expected);
  };
  SceneSpec spec = scenes::preset("type-i");
  expect_meshes(spec, {2, 2, 8});
  spec.loading.speed_m_per_s = 25.0;
  expect_meshes(spec, {1, 2, 8});
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  expect_meshes(spec, {1, 2, 8});
  spec = scenes::preset("type-i");
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  expect_meshes(spec, {2, 2, 8});
  spec = scenes::preset("type-i");
  spec.loading.direction = LoadingSpec::Direction::y;
  expect_meshes(spec, {2, 8, 16});
  expect_meshes(scenes::preset("type-ii-as-counted"), {8, 16, 32});
  expect_meshes(scenes::preset("type-iii-as-counted"), {8, 16, 32});
}

TEST(Fidelity, FollowsTheSlendernessOfTheWalls) {
  const auto standard_of = [](SceneSpec spec, double speed) {
    spec.loading.speed_m_per_s = speed;
    spec.elements_per_wall.reset();
    return *fill_in_fidelity(spec).elements_per_wall;
  };
  for (const auto& [slenderness, fast, slow] :
       {std::tuple(5.0, 4, 4), std::tuple(10.0, 2, 2), std::tuple(15.0, 4, 2), std::tuple(20.0, 8, 2)}) {
    SCOPED_TRACE(slenderness);
    SceneSpec spec = scenes::hexagon_specimen(4, 3);
    RegularLattice& cells = scenes::cells_of(spec);
    cells.wall_thickness_mm = *cells.side_mm / slenderness;
    cells.own.clear();
    for (const SceneSpec& each : {spec, scenes::as_network(spec)}) {
      EXPECT_EQ(standard_of(each, 100.0), fast);
      EXPECT_EQ(standard_of(each, 11.0), fast);
      EXPECT_EQ(standard_of(each, 10.0), slow);
    }
  }
  SceneSpec voronoi = scenes::preset("zheng-2005");
  EXPECT_EQ(standard_of(voronoi, 100.0), 2);
  std::get<VoronoiWalls>(voronoi.lattice).relative_density = 0.05;
  EXPECT_EQ(standard_of(voronoi, 100.0), 8);
  EXPECT_THAT(describe_fidelity(voronoi), HasSubstr("8, STANDARD for Voronoi honeycombs with walls at least 17 times"));
  SceneSpec squares = scenes::preset("type-ii-as-counted");
  scenes::cells_of(squares).wall_thickness_mm = 0.1 * *scenes::cells_of(squares).side_mm;
  EXPECT_EQ(standard_of(squares, 100.0), 8);
  SceneSpec nothing_known;
  nothing_known.lattice = RegularLattice{"hexagon", {}, {}, {}, {}, {}};
  EXPECT_EQ(standard_of(nothing_known, 100.0), 2);
}

RunStatus::Kind end_of(const SceneSpec& spec) {
  Simulation simulation(scenes::build(spec));
  scenes::watch(simulation, [](const Sample&) {});
  return simulation.status().kind;
}

// With one element per wall, walls of the crushed layer overlap by half of its volume, and the run ends.
TEST(Fidelity, DraftsOfFastCrushesReachTheirEnd) {
  SceneSpec spec = scenes::preset("type-i");
  spec.loading.end_strain = 0.2;
  spec.numerics.fidelity = NumericsSpec::Fidelity::draft;
  EXPECT_EQ(end_of(spec), RunStatus::Kind::finished);
  spec.elements_per_wall = 1;
  EXPECT_EQ(end_of(spec), RunStatus::Kind::overcompaction);
}

TEST(Fidelity, FastCrushesOfWallsAlongTheCrushHaveAFinerMesh) {
  SceneSpec spec = scenes::preset("type-i");
  const auto standard_at = [&spec](double speed) {
    spec.loading.speed_m_per_s = speed;
    return fill_in_fidelity(spec).elements_per_wall;
  };
  EXPECT_EQ(standard_at(100.0), 2);
  spec.loading.direction = LoadingSpec::Direction::y;
  EXPECT_EQ(standard_at(25.0), 2);
  EXPECT_EQ(describe_fidelity(spec), "Mesh: elements_per_wall is 2, STANDARD for hexagons.");
  EXPECT_EQ(standard_at(26.0), 8);
  EXPECT_EQ(describe_fidelity(spec),
            "Mesh: elements_per_wall is 8, STANDARD for hexagons with walls along the crush, faster than 25 m/s.");
  SceneSpec network = scenes::as_network(spec);
  network.elements_per_wall.reset();
  EXPECT_EQ(fill_in_fidelity(network).elements_per_wall, 8);
  network.loading.direction = LoadingSpec::Direction::x;
  EXPECT_EQ(fill_in_fidelity(network).elements_per_wall, 2);
  SceneSpec turned = spec;
  turned.changes.rotation_degrees = 80.0;
  EXPECT_EQ(fill_in_fidelity(turned).elements_per_wall, 2);
  turned.loading.direction = LoadingSpec::Direction::x;
  EXPECT_EQ(fill_in_fidelity(turned).elements_per_wall, 8);
  SceneSpec flat = spec;
  scenes::cells_of(flat).own["height_mm"] = 0.4 * *scenes::cells_of(flat).side_mm;
  EXPECT_EQ(fill_in_fidelity(flat).elements_per_wall, 2) << "most walls are slanted";
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  EXPECT_EQ(standard_at(26.0), 2);
}

TEST(Fidelity, IsTheSameCrushBitForBitAsWhatItFillsInAndTells) {
  const auto hash_after_steps = [](const SceneSpec& spec) {
    return scenes::hash_of(scenes::state_after(*scenes::build(spec), 200));
  };
  const SceneSpec plain = scenes::hexagon_specimen(4, 3);
  for (const FidelityPoint& point : fidelity_points(plain)) {
    SceneSpec spec = plain;
    spec.numerics.fidelity = point.fidelity;
    SceneSpec spelled = plain;
    spelled.elements_per_wall = point.elements_per_wall;
    EXPECT_EQ(hash_after_steps(spec), hash_after_steps(spelled)) << point.name;
    EXPECT_EQ(describe_fidelity(spec), "Mesh: elements_per_wall is " + std::to_string(point.elements_per_wall) + ", " +
                                           point.name + " for hexagons.");
    EXPECT_EQ(complete_spec(spec, *scenes::build(spec)).elements_per_wall, point.elements_per_wall);
    EXPECT_EQ(std::ranges::count(said_of(spec), describe_fidelity(spec)), 1) << point.name;
    spec.elements_per_wall = 3;
    EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 3) << "what is given stays";
    EXPECT_THAT(describe_fidelity(spec), HasSubstr("is given"));
  }
}

}  // namespace
}  // namespace cellcrush
