#include "cellcrush/spec_checker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <string>

#include "cellcrush/run_memory.h"
#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

std::string text_of(const Problems& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    text += problem.field + " " + problem.value + " " + problem.message + " " + problem.remedy + "\n";
  }
  return text;
}

/// The checker does not know whether contacts are searched by buckets after all, which list more pairs where elements
/// are shorter than walls are thick, nor whether the lattice is cut into bands.
void expect_memory_bound(const SpecChecker::Verdict& verdict, const SceneSpec& spec, const SceneResult& built) {
  if (!built.scene) {
    EXPECT_EQ(verdict.most_memory_bytes, 0);
    return;
  }
  const auto exact = static_cast<double>(memory_of_run(spec, *built.scene));
  const auto most = static_cast<double>(verdict.most_memory_bytes);
  EXPECT_GE(most, exact);
  EXPECT_LE(most, 1.6 * exact);
}

/// Returns whether the spec has problems.
bool expect_same_verdict(SpecChecker& checker, const SceneSpec& spec) {
  const SceneResult built = build_scene(spec);
  const SpecChecker::Verdict verdict = checker.check(spec);
  EXPECT_EQ(text_of(verdict.problems), text_of(built.problems));
  const SceneFacts facts = built.scene ? facts_of(*built.scene) : SceneFacts();
  EXPECT_EQ(verdict.element_count, facts.element_count);
  EXPECT_EQ(verdict.step_count, facts.step_count);
  Problems notes;
  if (built.scene) {
    notes = find_implausible(spec);
    std::ranges::copy(find_costly_walls(spec, *built.scene), std::back_inserter(notes));
  }
  EXPECT_EQ(text_of(verdict.notes), text_of(notes));
  expect_memory_bound(verdict, spec, built);
  return !verdict.problems.empty();
}

using Change = std::function<void(SceneSpec&)>;

/// Each way in which a spec may differ from the one before it, good and bad.
std::vector<Change> changes() {
  const auto hexagon = [](SceneSpec& spec) -> RegularLattice& { return scenes::cells_of(spec); };
  return {
      [](SceneSpec& spec) { spec.loading.speed_m_per_s = 20.0; },
      [](SceneSpec& spec) { spec.loading.speed_m_per_s = -20.0; },
      [](SceneSpec& spec) { spec.loading.speed_m_per_s = 1e-6; },
      [](SceneSpec& spec) { spec.loading.speed_m_per_s.reset(); },
      [](SceneSpec& spec) { spec.loading.quasi_static = true; },
      [](SceneSpec& spec) {
        spec.loading.speed_m_per_s.reset();
        spec.loading.quasi_static = true;
      },
      [](SceneSpec& spec) { spec.loading.end_strain = 0.3; },
      [](SceneSpec& spec) { spec.loading.ramp_strain = 0.1; },
      [](SceneSpec& spec) { spec.loading.direction = LoadingSpec::Direction::y; },
      [](SceneSpec& spec) { spec.contact.stiffness_factor = 0.01; },
      [](SceneSpec& spec) { spec.contact.damping_ratio = 0.9; },
      [](SceneSpec& spec) { spec.contact.impact_speed_m_per_s = 400.0; },
      [](SceneSpec& spec) { spec.contact.search = ContactSpec::Search::buckets; },
      [](SceneSpec& spec) { spec.plates.friction = 11.0; },
      [](SceneSpec& spec) { spec.numerics.time_step_s = 1e-9; },
      [](SceneSpec& spec) { spec.numerics.time_step_s = 1e-3; },
      [](SceneSpec& spec) { spec.numerics.mass_scaling = 4.0; },
      [](SceneSpec& spec) { spec.numerics.rotary_scaling = 3.0; },
      [](SceneSpec& spec) { spec.numerics.rigid_link_slenderness = 4.0; },
      [](SceneSpec& spec) { spec.numerics.fidelity = NumericsSpec::Fidelity::draft; },
      [](SceneSpec& spec) { spec.numerics.threads = 0; },
      [](SceneSpec& spec) { spec.output.sample_count = 1; },
      [](SceneSpec& spec) { spec.elements_per_wall = 3; },
      [](SceneSpec& spec) { spec.depth_mm = 8.0; },
      [](SceneSpec& spec) {
        spec.imperfection = Imperfection{0.1, 7};
      },
      [](SceneSpec& spec) {
        spec.imperfection = Imperfection{0.1, 8};
      },
      [](SceneSpec& spec) { spec.material.youngs_modulus_mpa = 2e5; },
      [](SceneSpec& spec) { spec.material.density_kg_per_m3 = std::numeric_limits<double>::quiet_NaN(); },
      [=](SceneSpec& spec) { hexagon(spec).rows = 5; },
      [=](SceneSpec& spec) { hexagon(spec).wall_thickness_mm = 0.1; },
      [=](SceneSpec& spec) { hexagon(spec).wall_thickness_mm = 1.9; },
      [](SceneSpec& spec) { spec.inclusions.rows = {2}; },
      [](SceneSpec& spec) { spec.lattice = scenes::squares(6, 5, 4.0, 0.2); },
      [](SceneSpec& spec) { spec.lattice = std::monostate(); },
  };
}

TEST(SpecChecker, SaysOfEverySpecWhatBuildingItsSceneSaysWhateverWasCheckedBefore) {
  SpecChecker checker;
  const SceneSpec plain = scenes::hexagon_specimen(8, 6);
  for (const Change& change : changes()) {
    SceneSpec changed = plain;
    change(changed);
    expect_same_verdict(checker, changed);
    expect_same_verdict(checker, plain);
    // Two changes at once, of which one may be known and the other not.
    changed.loading.speed_m_per_s = 33.0;
    expect_same_verdict(checker, changed);
  }
  for (const Change& change : changes()) {
    SceneSpec changed = plain;
    change(changed);
    expect_same_verdict(checker, changed);
  }
}

TEST(SpecChecker, SaysOfAFrameThatCrossesWhatBuildingItsSceneSays) {
  SpecChecker checker;
  SceneSpec spec = scenes::elastic_frame(
      scenes::touching_beams({{0.0, 0.0}, {20.0, 0.0}, {10.0, -5.0}, {10.0, 5.0}}, {{0, 1}, {2, 3}}, 0.5, 4));
  for (const bool self_contact : {false, true}) {
    for (const double end_time : {1e-4, 2e-4, 1e9}) {
      std::get<FrameWalls>(spec.lattice).self_contact = self_contact;
      spec.loading.end_time_s = end_time;
      expect_same_verdict(checker, spec);
    }
  }
  EXPECT_EQ(checker.check(spec).problems.empty(), false);
}

// With problems of its own, a scaling still makes masses and steps that other problems name.
TEST(SpecChecker, SaysOfScalingsOutOfRangeWhatBuildingTheirScenesSays) {
  SpecChecker checker;
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  for (const double time_step : {0.0, 1e-9, 1e-3}) {
    spec.numerics.time_step_s = time_step;
    for (const double scaling :
         {-1.0, 0.0, 0.5, 1e9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      spec.numerics.mass_scaling = scaling;
      spec.numerics.rotary_scaling = 1.0;
      expect_same_verdict(checker, spec);
      spec.numerics.mass_scaling = 1.0;
      spec.numerics.rotary_scaling = scaling;
      expect_same_verdict(checker, spec);
    }
  }
}

// Thick walls of few and many elements, and joints thrown far: walls that overlap before loading, and on either side
// of what is refused.
TEST(SpecChecker, SaysOfLatticesAtTheLimitOfOverlapWhatBuildingTheirScenesSays) {
  SceneSpec spec = scenes::hexagon_specimen(3, 3);
  SpecChecker checker;
  int refused = 0;
  const auto check_lattice = [&](const RegularLattice& lattice) {
    spec.lattice = lattice;
    refused += expect_same_verdict(checker, spec) ? 1 : 0;
  };
  for (int seed = 1; seed <= 15; ++seed) {
    const double thickness = 1.0 + 1.0 * (seed % 15) / 14.0;
    spec.imperfection = {0.16 + 0.24 * (seed % 8) / 7.0, static_cast<std::uint64_t>(seed)};
    spec.elements_per_wall = 1 + seed % 4;
    check_lattice(scenes::triangles(9, 8, 4.0, thickness));
    spec.imperfection.amplitude_mm = 0.4;
    check_lattice(scenes::hexagons(4, 3, 4.0, thickness, 2.0));
    check_lattice(scenes::squares(4, 3, 4.0, thickness));
  }
  EXPECT_EQ(refused, 0) << "walls that meet at small angles overlap, but do not cross";
  spec.imperfection = {0.05, 1};
  for (const int elements : {12, 48, 64}) {
    for (double thickness = 0.4; thickness <= 2.01; thickness += 0.4) {
      spec.elements_per_wall = elements;
      check_lattice(scenes::hexagons(3, 2, 4.0, thickness));
      check_lattice(scenes::squares(3, 2, 4.0, thickness));
      check_lattice(scenes::triangles(4, 4, 4.0, thickness));
    }
  }
  EXPECT_GT(refused, 2) << "walls far thicker than their elements are long";
}

TEST(SpecChecker, BuildsOneMeshForAllSpecsThatShareIt) {
  SpecChecker checker;
  SceneSpec spec = scenes::hexagon_specimen(8, 6);
  spec.imperfection = {0.1, 1};
  const std::int64_t elements = checker.elements_to_build(spec);
  EXPECT_GT(elements, 0);
  std::int64_t told = 0;
  const auto before_mesh = [&told](std::int64_t count) { told += count; };
  checker.check(spec, before_mesh);
  spec.loading.speed_m_per_s = 77.0;
  EXPECT_EQ(checker.elements_to_build(spec), 0);
  for (const double end_strain : {0.2, 0.8, 0.8, 0.2}) {
    spec.loading.end_strain = end_strain;
    spec.output.sample_count += 1;
    const auto verdict = checker.check(spec, before_mesh);
    EXPECT_EQ(verdict.most_memory_bytes, most_memory_of_run(spec, verdict.element_count));
  }
  EXPECT_EQ(told, elements);
  spec.imperfection.seed = 2;
  EXPECT_GT(checker.elements_to_build(spec), 0);
  checker.check(spec);
  spec.imperfection.seed = 1;
  EXPECT_EQ(checker.elements_to_build(spec), 0) << "the last meshes are known, not only the last";
}

TEST(SpecChecker, KnowsHowManyElementsAMeshHasAndBuildsNoneOfASceneThatItWasGiven) {
  for (const auto& preset : scenes::presets()) {
    SCOPED_TRACE(preset.name);
    SpecChecker checker;
    const auto before = static_cast<double>(checker.elements_to_build(preset.spec));
    const SceneResult built = build_scene(preset.spec);
    ASSERT_TRUE(built.scene);
    checker.know(preset.spec, *built.scene);
    EXPECT_EQ(checker.elements_to_build(preset.spec), 0);
    expect_same_verdict(checker, preset.spec);
    const auto elements = static_cast<double>(built.scene->element_count());
    EXPECT_GT(before, 0.8 * elements);
    EXPECT_LT(before, 2.0 * elements) << "rigid walls are an element each";
  }
}

TEST(SpecChecker, BuildsNoMeshThatIsTooLarge) {
  SpecChecker checker;
  SceneSpec spec = scenes::hexagon_specimen(10000, 10000);
  EXPECT_EQ(checker.elements_to_build(spec), 0);
  const Problems problems = checker.check(spec).problems;
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].field, "lattice.hexagon.columns");
}

}  // namespace
}  // namespace cellcrush
