// What is refused of a case, with field, value and remedy, and what is noted of one that is accepted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "cellcrush/spec_checker.h"
#include "fields/field_checker.h"
#include "scene/unit_sets.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "scenes/rigid_walls.h"

namespace cellcrush {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;
using Fields = std::vector<std::string>;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Fields fields_of(const Problems& problems) {
  Fields fields;
  for (const Problem& problem : problems) {
    fields.push_back(problem.field);
    EXPECT_FALSE(problem.remedy.empty()) << problem.field;
  }
  return fields;
}

/// Problems of 20 x 7 hexagons, changed.
Problems problems_with(const std::function<void(SceneSpec&)>& change) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  change(spec);
  return build_scene(spec).problems;
}

TEST(FieldChecker, AFieldWithoutLimitsIsAMistakeThatNamesIt) {
  FieldChecker check;
  EXPECT_TRUE(check.within_limits("lattice.frame.nodes[3].x_mm", 1.0));
  EXPECT_THROW(FieldChecker::greatest_of("zzz"), std::logic_error);
  try {
    check.within_limits("lattice.hexagon.rims[2].width_mm", 1.0);
    FAIL() << "was checked";
  } catch (const std::logic_error& error) {
    EXPECT_NE(std::string(error.what()).find("lattice.hexagon.rims.width_mm"), std::string::npos) << error.what();
  }
}

TEST(CheckSpec, EveryPresetIsSoundAndPlausible) {
  for (const auto& [name, spec] : scenes::presets()) {
    EXPECT_TRUE(build_scene(spec).problems.empty()) << name;
    EXPECT_THAT(find_implausible(spec), IsEmpty()) << name;
  }
}

TEST(CheckSpec, EmptyCaseNamesEverythingThatIsMissing) {
  EXPECT_THAT(fields_of(build_scene({}).problems),
              IsSupersetOf({"lattice", "depth_mm", "material.youngs_modulus_mpa", "material.yield_stress_mpa",
                            "material.density_kg_per_m3", "loading.speed_m_per_s"}));
}

TEST(CheckSpec, OnlyForceBasedElementsShear) {
  const Problems problems = problems_with([](SceneSpec& spec) {
    spec.section.formulation = SectionSpec::Formulation::displacement_based;
    spec.section.shear_deformation = true;
    spec.section.shear_factor = 1.2;
  });
  ASSERT_THAT(fields_of(problems), ElementsAre("section.shear_deformation", "section.shear_factor"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("FORCE_BASED"));
  EXPECT_EQ(problems[1].value, "1.2");
}

TEST(CheckSpec, OnlyWallsOfConstantVolumeThatHoldCoupleBendingWithStretching) {
  const Problems problems = problems_with([](SceneSpec& spec) {
    spec.section.area_rule = SectionSpec::AreaRule::constant_area;
    spec.section.coupled_bending = true;
    spec.material.failure_strain = 0.1;
  });
  ASSERT_THAT(fields_of(problems), ElementsAre("section.coupled_bending", "section.coupled_bending"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("CONSTANT_VOLUME"));
  EXPECT_THAT(problems[1].remedy, HasSubstr("material.failure_strain"));
}

TEST(CheckSpec, RefusesWhatTheCaseWouldNotUse) {
  const Problems problems = problems_with([](SceneSpec& spec) {
    spec.section.shear_factor = 0.7;
    spec.loading.kinetic_share = 0.02;
  });
  ASSERT_THAT(fields_of(problems), ElementsAre("section.shear_factor", "loading.kinetic_share"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("section.shear_deformation"));
  EXPECT_THAT(problems[1].remedy, HasSubstr("loading.quasi_static"));
}

TEST(CheckSpec, RefusesSoFewPointsThatElementsAreMechanismsOrFarOff) {
  const auto with = [](int axial, int depth) {
    return problems_with([&](SceneSpec& spec) {
      spec.section.formulation = SectionSpec::Formulation::displacement_based;
      spec.section.depth_rule = SectionSpec::DepthRule::lobatto;
      spec.section.axial_points = axial;
      spec.section.depth_points = depth;
    });
  };
  EXPECT_THAT(fields_of(with(1, 3)), ElementsAre("section.axial_points", "section.depth_points"));
  EXPECT_THAT(fields_of(with(6, 11)), ElementsAre("section.axial_points", "section.depth_points"));
  EXPECT_THAT(fields_of(with(2, 4)), ElementsAre());
  EXPECT_THAT(fields_of(with(5, 10)), ElementsAre());
}

TEST(CheckSpec, NamesAllProblemsAtOnceWithTheirValues) {
  const Problems problems = problems_with([](SceneSpec& spec) {
    scenes::cells_of(spec) = scenes::hexagons(20, 7, 4.0, -0.1);
    spec.loading.speed_m_per_s = 0.0;
    spec.material.density_kg_per_m3 = std::numeric_limits<double>::quiet_NaN();
    spec.material.isotropic_fraction = -0.5;
    spec.contact.impact_speed_m_per_s = -1.0;
    spec.section.depth_points = 1;
  });
  EXPECT_THAT(fields_of(problems), UnorderedElementsAre("lattice.hexagon.wall_thickness_mm", "loading.speed_m_per_s",
                                                        "material.density_kg_per_m3", "material.isotropic_fraction",
                                                        "contact.impact_speed_m_per_s", "section.depth_points"));
  for (const Problem& problem : problems) {
    if (problem.field == "lattice.hexagon.wall_thickness_mm") {
      EXPECT_EQ(problem.value, "-0.1");
    } else if (problem.field == "material.density_kg_per_m3") {
      EXPECT_THAT(problem.message, HasSubstr("finite"));
    }
  }
}

TEST(CheckSpec, RefusesAFixedStepAboveTheStableOneAndSaysBoth) {
  const Problems problems = problems_with([](SceneSpec& spec) { spec.numerics.time_step_s = 4e-7; });
  ASSERT_THAT(fields_of(problems), ElementsAre("numerics.time_step_s"));
  EXPECT_EQ(problems[0].value, "4e-07");
  EXPECT_THAT(problems[0].message, HasSubstr("3.91"));
}

TEST(CheckSpec, ImperfectionBowAndInclusionsAreBoundedByTheLattice) {
  EXPECT_THAT(fields_of(problems_with([](SceneSpec& spec) {
                spec.imperfection.amplitude_mm = 0.5;
                spec.imperfection.bow_mm = 0.21;
                spec.inclusions.rows = {0, 3, 8};
                spec.inclusions.thickness_factor = 100.0;
              })),
              UnorderedElementsAre("lattice.imperfection.amplitude_mm", "lattice.imperfection.bow_mm",
                                   "lattice.inclusions.rows[0]", "lattice.inclusions.rows[2]",
                                   "lattice.inclusions.thickness_factor"));
  const auto bowed = [](int elements) {
    return problems_with([elements](SceneSpec& spec) {
      spec.imperfection.bow_mm = 0.01;
      spec.elements_per_wall = elements;
    });
  };
  EXPECT_THAT(bowed(2), IsEmpty());
  EXPECT_THAT(fields_of(bowed(1)), ElementsAre("lattice.imperfection.bow_mm"));
  SceneSpec frame = scenes::Cantilever::spec(4, FrameLattice::Component::y, 1.0, 0.1, 0.2);
  frame.imperfection.bow_mm = 0.01;
  EXPECT_THAT(fields_of(build_scene(frame).problems), IsSupersetOf({"lattice.imperfection.bow_mm"}));
}

TEST(CheckSpec, RefusesALatticeOfRigidCellsAlone) {
  SceneSpec spec = scenes::hexagon_specimen(8, 3);
  spec.inclusions.rows = {1, 2, 3, 2};
  EXPECT_THAT(fields_of(build_scene(spec).problems), ElementsAre("lattice.inclusions.rows"));
  spec.inclusions.model = Inclusions::Model::meshed;
  EXPECT_THAT(build_scene(spec).problems, IsEmpty());
  spec.inclusions = {{1, 3}};
  EXPECT_THAT(build_scene(spec).problems, IsEmpty());
}

/// A bar along x, 1 mm thick, from 0 to 100, that has a wall.
Problems problems_of(const LoadsSpec::RigidWall& wall) {
  SceneSpec spec = scenes::FallingBar::spec(2);
  spec.loads.rigid_walls = {wall};
  return build_scene(spec).problems;
}

TEST(CheckRigidWalls, AcceptsThemWhereTheyTouchTheFrameOrNot) {
  EXPECT_THAT(problems_of({-10.0, 5.0, 2.0, 0.0, 0.3, {}}), IsEmpty());
  EXPECT_THAT(problems_of({-0.25, 0.0, 1.0, 0.0, 0.0, {}}), IsEmpty());
  EXPECT_THAT(problems_of({-0.25, 7.0, 1.0, 0.0, 0.0, {{0.0, -1.0}, {1.0, 3.0}}}), IsEmpty());
}

TEST(CheckRigidWalls, RefusesWhatIsNoneAndAFrameThatStandsInOne) {
  struct Refused {
    LoadsSpec::RigidWall wall;
    std::string field, value, message;
  };
  for (const auto& [wall, field, value, message] : std::vector<Refused>{
           {{-10.0, 0.0, 0.0, 0.0, 0.0, {}}, ".normal_x", "0", "no direction"},
           {{kInfinite, 0.0, 1.0, 0.0, 0.0, {}}, ".x_mm", "inf", "finite"},
           {{-10.0, 2e9, 1.0, 0.0, 0.0, {}}, ".y_mm", "2e+09", "too large"},
           {{-10.0, 0.0, 1.0, kInfinite, 0.0, {}}, ".normal_y", "inf", "finite"},
           {{-10.0, 0.0, 1.0, 0.0, -0.1, {}}, ".friction", "-0.1", "too small"},
           {{-10.0, 0.0, 1.0, 0.0, 0.0, {{1.0, 0.0}, {1.0, 2.0}}}, ".displacement_mm.points", "", "function of time"},
           {{0.0, 0.0, 1.0, 0.0, 0.0, {}}, "", "0.25 mm", "lattice.frame.nodes[0]"},
           {{-10.0, 0.0, -3.0, 0.0, 0.0, {}}, "", "110.25 mm", "lattice.frame.nodes[1]"},  // the wrong way round
           {{-0.25, 0.0, 1.0, 0.0, 0.0, {{0.0, 0.5}, {1.0, 0.0}}}, "", "0.5 mm", "time 0"}}) {
    const Problems problems = problems_of(wall);
    ASSERT_THAT(fields_of(problems), ElementsAre("loading.rigid_walls[0]" + field)) << message;
    EXPECT_EQ(problems[0].value, value);
    EXPECT_THAT(problems[0].message, HasSubstr(message));
  }
}

Fields fields_noted(const std::function<void(SceneSpec&)>& change) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  change(spec);
  return fields_of(find_implausible(spec));
}

TEST(Plausibility, SoundMaterialsAreNotNoted) {
  struct Sound {
    double modulus, yield, density;
  };
  // Steel, titanium, nylon, tungsten, soft annealed copper.
  for (const Sound& sound : {Sound{210000, 800, 7850}, Sound{114000, 880, 4430}, Sound{2700, 60, 1140},
                             Sound{400000, 750, 19250}, Sound{117000, 33, 8960}}) {
    const auto noted = fields_noted([&](SceneSpec& spec) {
      spec.material.youngs_modulus_mpa = sound.modulus;
      spec.material.yield_stress_mpa = sound.yield;
      spec.material.density_kg_per_m3 = sound.density;
    });
    EXPECT_THAT(noted, IsEmpty()) << sound.modulus;
  }
}

TEST(Plausibility, UnitsThatAreMistakenAndWhatIsBeyondTheModelAreNotedByName) {
  const auto with = [](std::optional<double> MaterialSpec::*field, double value) {
    return fields_noted([&](SceneSpec& spec) { spec.material.*field = value; });
  };
  for (const double density : {2.68, 2.7e-9, 270.0}) {
    EXPECT_THAT(with(&MaterialSpec::density_kg_per_m3, density), ElementsAre("material.density_kg_per_m3"));
  }
  EXPECT_THAT(with(&MaterialSpec::youngs_modulus_mpa, 70),
              ElementsAre("material.youngs_modulus_mpa", "material.yield_stress_mpa", "loading.speed_m_per_s"));
  EXPECT_THAT(with(&MaterialSpec::youngs_modulus_mpa, 69e9),
              ElementsAre("material.youngs_modulus_mpa", "material.yield_stress_mpa"));
  for (const double yield : {76e3, 0.292}) {
    EXPECT_THAT(with(&MaterialSpec::yield_stress_mpa, yield), ElementsAre("material.yield_stress_mpa"));
  }
  const auto of_walls = [](double share) {
    return fields_noted([share](SceneSpec& spec) { scenes::cells_of(spec).wall_thickness_mm = share * 4.0; });
  };
  EXPECT_THAT(of_walls(0.19), IsEmpty());
  EXPECT_THAT(of_walls(0.0004), ElementsAre("lattice.hexagon.wall_thickness_mm"));
  const auto at_speed = [](double speed) {
    return fields_noted([speed](SceneSpec& spec) { spec.loading.speed_m_per_s = speed; });
  };
  EXPECT_THAT(at_speed(600), ElementsAre("loading.speed_m_per_s"));
  EXPECT_THAT(at_speed(400), IsEmpty());
}

/// The same hexagons, in other units: aluminium, sides of 4 mm, walls of 0.2 mm, 100 m/s.
SceneSpec hexagons_in(double length, double stress, double density, double speed = 1.0) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  scenes::cells_of(spec).own.clear();
  scenes::cells_of(spec).side_mm = 4.0 * length;
  scenes::cells_of(spec).wall_thickness_mm = 0.2 * length;
  spec.material.youngs_modulus_mpa = 69000.0 * stress;
  spec.material.yield_stress_mpa = 76.0 * stress;
  spec.material.density_kg_per_m3 = 2700.0 * density;
  spec.loading.speed_m_per_s = 100.0 * speed;
  return spec;
}

TEST(OtherUnits, AreNamedAsASetWithTheConvertedFields) {
  struct Written {
    SceneSpec spec;
    const char* units;
    std::vector<const char*> remedies;
  };
  const char* const kDensity = "material.density_kg_per_m3 as 2700 kg/m^3";
  const char* const kModulus = "material.youngs_modulus_mpa as 69000 MPa";
  const char* const kYield = "material.yield_stress_mpa as 76 MPa";
  const char* const kWall = "lattice.hexagon.wall_thickness_mm as 0.2 mm";
  const char* const kSpeed = "loading.speed_m_per_s as 100 m/s";
  for (const auto& [spec, units, remedies] : std::vector<Written>{
           {hexagons_in(1.0, 1.0, 1e-12), "tonne/mm^3", {kDensity}},
           {hexagons_in(1.0, 1.0, 1e-12, 1e3), "tonne/mm^3", {kDensity, kSpeed}},
           {hexagons_in(1.0, 1.0, 1e-9), "MPa and kg/mm^3", {kDensity}},
           {hexagons_in(1.0, 1e-3, 1e-9), "kN, ms and kg/mm^3", {kModulus, kYield, kDensity}},
           {hexagons_in(1.0, 1e-3, 1e-3), "GPa and g/cm^3", {kModulus, kYield, kDensity}},
           {hexagons_in(1.0, 1.0, 1e-3), "MPa and g/cm^3", {kDensity}},
           {hexagons_in(1.0, 1e-3, 1.0), "GPa and kg/m^3", {kModulus, kYield}},
           {hexagons_in(1e-3, 1e6, 1.0), "(SI)", {kModulus, kYield, kWall, "all other lengths times 1000"}},
           {hexagons_in(1.0, 1e6, 1.0), "mm, Pa", {kModulus, kYield}},
           {hexagons_in(1e-3, 1.0, 1.0), "m, MPa", {kWall}},
           {hexagons_in(0.1, 1e2, 1e-3), "cm, N/cm^2 and g/cm^3", {kModulus, kDensity, kWall}},
           {hexagons_in(0.1, 1e2, 1e-8, 1e2), "N s^2/cm^4", {kModulus, kDensity, kWall, kSpeed}}}) {
    const auto asked = find_other_units(spec);
    ASSERT_TRUE(asked) << units;
    EXPECT_THAT(asked->message, HasSubstr(units));
    for (const char* remedy : remedies) EXPECT_THAT(asked->remedy, HasSubstr(remedy)) << units;
    EXPECT_EQ(find_implausible(spec).back().message, asked->message);
  }
  EXPECT_FALSE(find_other_units(hexagons_in(1.0, 1.0, 1.0)));
  EXPECT_FALSE(find_other_units(hexagons_in(1.0, 1e3, 1.0))) << "in no units";
}

TEST(OtherUnits, ComeBeforeWhatFollowsFromThem) {
  SceneSpec tonnes = hexagons_in(1.0, 1.0, 1e-12);  // below the range of densities
  SceneSpec slow = hexagons_in(1.0, 1.0, 1e-9);
  slow.loading.speed_m_per_s = 1e-5;  // more steps than any machine can do
  for (const SceneSpec& spec : {tonnes, slow}) {
    const Problems problems = build_scene(spec).problems;
    ASSERT_THAT(fields_of(problems), ElementsAre("material.density_kg_per_m3"));
    EXPECT_THAT(problems[0].remedy, HasSubstr("2700 kg/m^3"));
  }
}

TEST(OtherUnits, OfFramesAndNetworksAreNamedToo) {
  SceneSpec network = scenes::as_network(hexagons_in(1e-3, 1e6, 1.0));
  SceneSpec frame = scenes::elastic_frame(scenes::bar(20e-3, 0.5e-3, 4));
  frame.material = network.material;
  SceneSpec of_beams = frame;
  std::get<FrameWalls>(of_beams.lattice).beams[0].material = frame.material;
  of_beams.material = {};
  for (const SceneSpec& spec : {network, frame, of_beams}) {
    const auto asked = find_other_units(spec);
    ASSERT_TRUE(asked);
    EXPECT_THAT(asked->message, HasSubstr("(SI)"));
    EXPECT_THAT(asked->remedy, HasSubstr("youngs_modulus_mpa as 69000 MPa"));
    EXPECT_THAT(asked->remedy, HasSubstr("lengths times 1000"));
  }
  EXPECT_THAT(find_other_units(of_beams)->field, "lattice.frame.beams[0].material.youngs_modulus_mpa");
}

TEST(Plausibility, ThickWallsAreToldWhatShearIsWorth) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  scenes::cells_of(spec).own.clear();
  scenes::cells_of(spec).wall_thickness_mm = 0.24 * 4.0;
  SceneSpec network = scenes::as_network(spec);
  SceneSpec voronoi = spec;
  voronoi.lattice = VoronoiWalls{.columns = 20,
                                 .rows = 7,
                                 .side_mm = 4.0,
                                 .irregularity = 0.5,
                                 .wall_thickness_mm = {},
                                 .relative_density = 0.24 * 2.0 / std::numbers::sqrt3};
  for (SceneSpec thick : {spec, network, voronoi}) {
    const Problems notes = find_implausible(thick);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_THAT(notes[0].message, HasSubstr("about 18 % too stiff before they yield"));  // 3.192 x 0.24^2
    EXPECT_THAT(notes[0].remedy, HasSubstr("section.shear_deformation"));
    thick.section.shear_deformation = true;
    EXPECT_THAT(find_implausible(thick), IsEmpty());
  }
  spec.section.shear_deformation = true;
  scenes::cells_of(spec).wall_thickness_mm = 0.26 * 4.0;
  const Problems notes = find_implausible(spec);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0].message, HasSubstr("have no size in the model"));
}

TEST(Plausibility, ANoteSaysWhatMayBeMeant) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  spec.material.density_kg_per_m3 = 2.68;
  const auto notes = find_implausible(spec);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].value, "2.68");
  EXPECT_THAT(notes[0].message, HasSubstr("g/cm^3"));
  EXPECT_THAT(notes[0].remedy, HasSubstr("2680 kg/m^3"));
}

}  // namespace
}  // namespace cellcrush
