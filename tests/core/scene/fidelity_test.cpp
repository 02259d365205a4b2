#include "cellcrush/fidelity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cellcrush/presets.h"
#include "cellcrush/simulation.h"
#include "scene/measured_errors.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

using Fidelity = NumericsSpec::Fidelity;

SceneSpec specimen(Fidelity fidelity) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  spec.numerics.fidelity = fidelity;
  return spec;
}

SceneSpec a_frame() { return scenes::Cantilever::spec(4, FrameLattice::Component::y, 1.0, 0.1, 0.2); }

std::uint64_t hash_after_steps(const SceneSpec& spec) {
  Simulation simulation(scenes::build(spec));
  simulation.advance(200);
  return scenes::hash_of(simulation.state());
}

TEST(Fidelity, WithoutOneTheMeshIsTheLatticesStandard) {
  SceneSpec spec = specimen(Fidelity::unspecified);
  EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 2);
  EXPECT_EQ(describe_fidelity(spec), "Mesh: elements_per_wall is 2, STANDARD for hexagons.");
  for (const char* preset : {"type-ii-as-counted", "type-iii-as-counted"}) {
    spec = find_preset(preset)->spec;
    EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 16) << preset;
    EXPECT_NE(describe_fidelity(spec).find("is 16, STANDARD for squares and triangles"), std::string::npos);
    spec.section.formulation = SectionSpec::Formulation::displacement_based;
    EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 2) << "the paper's elements keep the paper's mesh";
    EXPECT_NE(describe_fidelity(spec).find("not known"), std::string::npos);
  }
  EXPECT_EQ(fill_in_fidelity(a_frame()).elements_per_wall, 2);
  EXPECT_EQ(describe_fidelity(a_frame()), "");
}

TEST(Fidelity, EveryLatticeHasACoarserAndAFinerMesh) {
  const auto meshes_of = [](const SceneSpec& spec) {
    std::vector<int> meshes;
    for (const FidelityPoint& point : fidelity_points(spec)) meshes.push_back(point.elements_per_wall);
    return meshes;
  };
  SceneSpec spec = find_preset("type-i")->spec;
  EXPECT_EQ(meshes_of(spec), (std::vector<int>{1, 2, 8}));
  spec.loading.direction = LoadingSpec::Direction::y;
  EXPECT_EQ(meshes_of(spec), (std::vector<int>{2, 8, 16}));
  for (const char* preset : {"type-ii-as-counted", "type-iii-as-counted"}) {
    EXPECT_EQ(meshes_of(find_preset(preset)->spec), (std::vector<int>{8, 16, 32})) << preset;
  }
}

TEST(Fidelity, FastCrushesOfHexagonsAlongYHaveAFinerMesh) {
  SceneSpec spec = find_preset("type-i")->spec;
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
            "Mesh: elements_per_wall is 8, STANDARD for hexagons crushed along y faster than 25 m/s.");
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  EXPECT_EQ(standard_at(26.0), 2);
}

TEST(Fidelity, IsTheSameCrushBitForBitAsWhatItFillsIn) {
  for (const FidelityPoint& point : fidelity_points(specimen(Fidelity::unspecified))) {
    SceneSpec spelled = specimen(Fidelity::unspecified);
    spelled.elements_per_wall = point.elements_per_wall;
    EXPECT_EQ(hash_after_steps(specimen(point.fidelity)), hash_after_steps(spelled)) << point.name;
  }
}

TEST(Fidelity, WhatIsGivenStays) {
  for (const FidelityPoint& point : fidelity_points(specimen(Fidelity::unspecified))) {
    SceneSpec spec = specimen(point.fidelity);
    EXPECT_EQ(describe_fidelity(spec), "Mesh: elements_per_wall is " + std::to_string(point.elements_per_wall) + ", " +
                                           point.name + " for hexagons.");
    spec.elements_per_wall = 3;
    EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 3);
    EXPECT_NE(describe_fidelity(spec).find("is given"), std::string::npos);
  }
}

TEST(Fidelity, IsCompletedAndTold) {
  for (const FidelityPoint& point : fidelity_points(specimen(Fidelity::unspecified))) {
    const SceneSpec spec = specimen(point.fidelity);
    const auto scene = scenes::build(spec);
    const SceneSpec complete = complete_spec(spec, *scene);
    EXPECT_EQ(complete.elements_per_wall, point.elements_per_wall);
    const auto modelled = facts_of(*scene).modelled;
    EXPECT_EQ(std::count(modelled.begin(), modelled.end(), describe_fidelity(spec)), 1) << point.name;
  }
}

TEST(Fidelity, EachIsForecastForTheCaseAtHand) {
  SpecChecker checker;
  const auto forecasts = forecast_fidelities(specimen(Fidelity::unspecified), checker);
  ASSERT_EQ(forecasts.size(), 3u);
  for (const FidelityForecast& forecast : forecasts) {
    const SceneFacts facts = facts_of(*scenes::build(specimen(forecast.point.fidelity)));
    EXPECT_EQ(forecast.element_count, facts.element_count);
    EXPECT_EQ(forecast.step_count, facts.step_count);
    EXPECT_FALSE(forecast.given.empty()) << "four cells are not what was measured";
    EXPECT_TRUE(forecast.errors.empty());
  }
}

std::vector<std::string> measures_at(double speed) {
  SpecChecker checker;
  SceneSpec spec = find_preset("type-i")->spec;
  spec.loading.speed_m_per_s = speed;
  std::vector<std::string> measures;
  const auto forecasts = forecast_fidelities(spec, checker);
  EXPECT_EQ(forecasts.size(), 3u);
  for (const MeasuredError& error : forecasts[1].errors) measures.push_back(error.measure);
  return measures;
}

TEST(Fidelity, ErrorsAreThoseOfTheSpeedsBesideTheCases) {
  EXPECT_EQ(measures_at(100.0),
            (std::vector<std::string>{"impact plateau, type-i, 100 m/s", "support plateau, type-i, 100 m/s"}));
  EXPECT_EQ(measures_at(90.0), (std::vector<std::string>{"impact plateau, type-i, 75 to 100 m/s",
                                                         "support plateau, type-i, 75 to 100 m/s"}));
  EXPECT_TRUE(measures_at(10.0).empty());
  EXPECT_TRUE(measures_at(201.0).empty());
}

TEST(Fidelity, BetweenTwoSpeedsTheLargerErrorCounts) {
  SceneSpec spec = find_preset("type-i")->spec;
  const auto claimed_at = [&spec](double speed) {
    spec.loading.speed_m_per_s = speed;
    return measured_errors_of(spec, 2).back().claimed();
  };
  EXPECT_EQ(claimed_at(90.0), std::max(claimed_at(75.0), claimed_at(100.0)));
}

TEST(Fidelity, ErrorsOfASpecimenHoldForMoreCells) {
  SceneSpec spec = find_preset("type-ii-as-counted")->spec;
  for (const int elements : {8, 16, 32}) {
    const std::vector<MeasuredError> errors = measured_errors_of(spec, elements);
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0].measure, "impact plateau, 18 x 9 cells of type-ii-as-counted, 100 m/s");
  }
  std::get<SquareLattice>(spec.lattice).columns = 17;
  EXPECT_EQ(fields_beside_measured(spec), (std::vector<std::string>{"lattice.square.columns"}));
  EXPECT_TRUE(measured_errors_of(spec, 8).empty());
}

TEST(Fidelity, ErrorsAreThoseOfTheDirectionOfTheCrush) {
  SceneSpec spec = find_preset("type-i")->spec;
  spec.loading.direction = LoadingSpec::Direction::y;
  const std::vector<MeasuredError> errors = measured_errors_of(spec, 2);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[1].measure, "support plateau, 18 x 21 cells of type-i along y, 100 m/s");
}

TEST(Fidelity, NoErrorIsToldOfWhatWasNotMeasured) {
  SpecChecker checker;
  SceneSpec spec = find_preset("type-i")->spec;
  spec.loading.speed_m_per_s = 5.0;
  spec.material.hardening_modulus_mpa = 100.0;
  std::get<HexagonLattice>(spec.lattice).wall_thickness_mm = 0.2;
  spec.section.depth_rule = SectionSpec::DepthRule::lobatto;
  spec.numerics.rotary_scaling = 3.0;
  for (const FidelityForecast& forecast : forecast_fidelities(spec, checker)) {
    EXPECT_TRUE(forecast.errors.empty());
    EXPECT_EQ(forecast.given,
              (std::vector<std::string>{"lattice.hexagon.wall_thickness_mm", "material.hardening_modulus_mpa",
                                        "loading.speed_m_per_s", "section.depth_rule", "numerics.rotary_scaling"}));
  }
  EXPECT_TRUE(forecast_fidelities(a_frame(), checker).empty());
}

// A mesh that the case itself gives and that was measured has its error too; another has none.
TEST(Fidelity, AMeshThatIsGivenHasTheErrorOfThatMesh) {
  SpecChecker checker;
  SceneSpec spec = find_preset("type-i")->spec;
  spec.elements_per_wall = 4;
  EXPECT_FALSE(forecast_fidelities(spec, checker).front().errors.empty());
  spec.elements_per_wall = 3;
  EXPECT_TRUE(forecast_fidelities(spec, checker).front().errors.empty());
}

// A step that two elements a wall can bear and eight cannot.
TEST(Fidelity, OneAtWhichTheCaseCannotRunIsNotForecast) {
  SpecChecker checker;
  SceneSpec spec = specimen(Fidelity::unspecified);
  spec.numerics.time_step_s = 2e-7;
  const auto forecasts = forecast_fidelities(spec, checker);
  ASSERT_EQ(forecasts.size(), 2u);
  EXPECT_EQ(forecasts.back().point.fidelity, Fidelity::standard);
}

}  // namespace
}  // namespace cellcrush
