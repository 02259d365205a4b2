#include "cellcrush/fidelity.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cellcrush/simulation.h"
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

std::uint64_t hash_after_steps(const SceneSpec& spec) {
  Simulation simulation(scenes::build(spec));
  simulation.advance(200);
  return scenes::hash_of(simulation.state());
}

TEST(Fidelity, WithoutOneTheDefaultsStay) {
  const SceneSpec spec = specimen(Fidelity::unspecified);
  EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 2);
  EXPECT_EQ(describe_fidelity(spec), "");
}

TEST(Fidelity, IsTheSameCrushBitForBitAsWhatItFillsIn) {
  for (const FidelityPoint& point : fidelity_points()) {
    SceneSpec spelled = specimen(Fidelity::unspecified);
    spelled.elements_per_wall = point.elements_per_wall;
    EXPECT_EQ(hash_after_steps(specimen(point.fidelity)), hash_after_steps(spelled)) << point.name;
  }
}

TEST(Fidelity, WhatIsGivenStays) {
  for (const FidelityPoint& point : fidelity_points()) {
    SceneSpec spec = specimen(point.fidelity);
    EXPECT_EQ(describe_fidelity(spec),
              "Fidelity " + point.name + ": elements_per_wall is " + std::to_string(point.elements_per_wall) + ".");
    spec.elements_per_wall = 3;
    EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 3);
    EXPECT_NE(describe_fidelity(spec).find("is given"), std::string::npos);
  }
}

TEST(Fidelity, IsCompletedAndTold) {
  for (const FidelityPoint& point : fidelity_points()) {
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
    EXPECT_FALSE(forecast.point.errors.empty());
    EXPECT_TRUE(forecast.given.empty());
  }
}

TEST(Fidelity, NoErrorIsToldOfWhatWasNotMeasured) {
  SpecChecker checker;
  SceneSpec spec = specimen(Fidelity::unspecified);
  spec.elements_per_wall = 3;
  spec.section.depth_rule = SectionSpec::DepthRule::lobatto;
  spec.numerics.rotary_scaling = 3.0;
  for (const FidelityForecast& forecast : forecast_fidelities(spec, checker)) {
    EXPECT_TRUE(forecast.point.errors.empty());
    EXPECT_EQ(forecast.point.elements_per_wall, 3);
    EXPECT_EQ(forecast.point.step_cost, 1.0);
    EXPECT_EQ(forecast.given,
              (std::vector<std::string>{"elements_per_wall", "section.depth_rule", "numerics.rotary_scaling"}));
  }
  EXPECT_TRUE(
      forecast_fidelities(scenes::Cantilever::spec(4, FrameLattice::Component::y, 1.0, 0.1, 0.2), checker).empty());
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
