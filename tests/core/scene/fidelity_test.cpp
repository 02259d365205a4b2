#include "cellcrush/fidelity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
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
    spec = scenes::preset(preset);
    EXPECT_EQ(fill_in_fidelity(spec).elements_per_wall, 16) << preset;
    EXPECT_NE(describe_fidelity(spec).find("is 16, STANDARD for " + scenes::cells_of(spec).kind + "s, whose walls"),
              std::string::npos);
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
  SceneSpec spec = scenes::preset("type-i");
  EXPECT_EQ(meshes_of(spec), (std::vector<int>{1, 2, 8}));
  spec.loading.direction = LoadingSpec::Direction::y;
  EXPECT_EQ(meshes_of(spec), (std::vector<int>{2, 8, 16}));
  for (const char* preset : {"type-ii-as-counted", "type-iii-as-counted"}) {
    EXPECT_EQ(meshes_of(scenes::preset(preset)), (std::vector<int>{8, 16, 32})) << preset;
  }
}

TEST(Fidelity, FastCrushesOfHexagonsAlongYHaveAFinerMesh) {
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

}  // namespace
}  // namespace cellcrush
