// The largest fibre strain of a wall, against closed forms: arcs, stretched bars, cantilevers and even plastic bending.
#include "measure/fibre_strain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/textbook.h"
#include "step/advance_step.h"

namespace cellcrush::fibre_strains {
namespace {

using scenes::Cantilever;
using scenes::PlasticFrame;
using Component = FrameLattice::Component;

/// Bars of length 10 mm and thickness 0.5 mm, one above the other, whose particles lie on arcs of given whole turns,
/// first turned as a whole. Particles are found from start to end by their place before loading.
struct Arcs {
  std::shared_ptr<const Scene> scene;
  State state;
};

Arcs make_arcs(int elements, const std::vector<double>& turns, double turned_before) {
  FrameLattice frame;
  for (std::size_t b = 0; b < turns.size(); ++b) {
    const auto y = static_cast<double>(b);
    const int start = static_cast<int>(2 * b);
    frame.nodes.insert(frame.nodes.end(), {{0.0, y, 0.0, 0.0}, {10.0, y, 0.0, 0.0}});
    frame.beams.push_back(scenes::bar(10.0, 0.5, elements).beams.front());
    frame.beams.back().start = start;
    frame.beams.back().end = start + 1;
  }
  const auto scene = scenes::build(scenes::elastic_frame(std::move(frame)));
  State state = make_initial_state(*scene);
  const double chord = 10.0 / elements;
  for (std::size_t b = 0; b < turns.size(); ++b) {
    Vector2 place = Vector2::Zero();
    double angle = turned_before;
    for (int j = 0; j <= elements; ++j) {
      const Vector2 before(chord * j, static_cast<double>(b));
      const auto at = static_cast<std::size_t>(
          std::ranges::find_if(scene->position, [&](const Vector2& p) { return (p - before).norm() < 1e-6; }) -
          scene->position.begin());
      state.position[at] = place;
      state.rotation[at] = angle;
      place += chord * scenes::direction(angle + 0.5 * turns[b] / elements);
      angle += turns[b] / elements;
    }
  }
  for (std::size_t e = 0; e < scene->element_count(); ++e) {
    const Vector2 span = state.position[scene->elements[e].end] - state.position[scene->elements[e].start];
    state.length[e] = span.norm();
    state.axis[e] = span.normalized();
  }
  return {scene, std::move(state)};
}

double strain_on_arc(int elements, double turn, double turned_before) {
  const auto [scene, state] = make_arcs(elements, {turn}, turned_before);
  return find_largest_fibre_strain(*scene, state, scene->walls.blocks).strain;
}

TEST(FibreStrain, OfAnArcIsHalfOfTheThicknessTimesItsCurvatureWhateverTheTurns) {
  for (const int elements : {1, 2, 3, 8, 16}) {
    for (const double turn : {0.1, -1.0, 2.0}) {
      for (const double before : {0.0, 3.0, -20.0}) {
        EXPECT_NEAR(strain_on_arc(elements, turn, before), 0.25 * std::abs(turn) / 10.0, 1e-13)
            << elements << ' ' << turn << ' ' << before;
      }
    }
  }
  EXPECT_NEAR(strain_on_arc(32, 4.0 * std::numbers::pi, 0.0), 0.25 * 0.4 * std::numbers::pi, 1e-12) << "two turns";
}

// Sixteen walls fill a block, which is computed by vectors; the last two are computed one at a time.
TEST(FibreStrain, OfWallsSideBySideIsThatOfEachByItself) {
  constexpr int kBars = 18;
  std::vector<double> turns;
  for (int bar = 0; bar < kBars; ++bar) turns.push_back(0.3 * (bar - 7));
  for (const int elements : {1, 2, 3, 4}) {
    auto [scene, state] = make_arcs(elements, turns, 2.5);
    const auto squashed = [](int bar) { return 1.0 + 0.003 * (bar % 10); };
    for (std::size_t e = 0; e < scene->element_count(); ++e) {
      const double y = scene->position[scene->elements[e].start].y();
      state.shortening[e] = squashed(static_cast<int>(std::lround(y)));
    }
    std::vector<float> strains;
    evaluate_fibre_strains(*scene, state, strains);
    ASSERT_EQ(strains.size(), turns.size());
    for (int bar = 0; bar < kBars; ++bar) {
      const double axial = squashed(bar) - 1.0 - std::log(squashed(bar));
      const double bending = 0.25 * std::abs(turns[static_cast<std::size_t>(bar)]) / 10.0 * squashed(bar);
      EXPECT_FLOAT_EQ(strains[static_cast<std::size_t>(bar)], static_cast<float>(axial + bending))
          << elements << " elements, bar " << bar;
    }
    const WallStrain largest = find_largest_fibre_strain(*scene, state, scene->walls.blocks);
    EXPECT_EQ(static_cast<float>(largest.strain), std::ranges::max(strains));
    EXPECT_EQ(strains[static_cast<std::size_t>(scene->list_order.listed_wall(largest.wall))],
              std::ranges::max(strains));
  }
}

/// A steel bar, pulled (or pushed) slowly and evenly by `strain`; yield strain 0.001.
std::vector<Sample> stretched(double strain, double hardening, int elements) {
  FrameLattice frame = scenes::bar(10.0, 1.0, elements);
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  const double end = 1e-3;
  frame.motions = {{1, Component::x, {{0.0, 0.0}, {end, 10.0 * strain}}}};
  frame.end_time_s = end;
  frame.watched_nodes = {1};
  SceneSpec spec = scenes::plastic_frame(std::move(frame), 200000.0, 200.0);
  spec.material.hardening_modulus_mpa = hardening;
  spec.output.sample_count = 20;
  return scenes::run_frame(spec);
}

TEST(FibreStrain, OfAPulledBarIsItsElongationWhetherItYieldsOrNot) {
  double worst = 0.0;
  for (const double strain : {0.0005, 0.01}) {
    for (const double hardening : {0.0, 2000.0}) {
      const Sample last = stretched(strain, hardening, 1).back();
      worst = std::max(worst, std::abs(last.largest_fibre_strain / strain - 1.0));
      EXPECT_NEAR(last.largest_fibre_strain, last.watched.front().ux / 10.0, 1e-11);
    }
  }
  EXPECT_LT(worst, 1e-3);
}

TEST(FibreStrain, OfASquashedBarIsLogarithmic) {
  const Sample last = stretched(-0.3, 2000.0, 1).back();
  scenes::record_bound("squashed bar", last.largest_fibre_strain / -std::log(1.0 - 0.3) - 1.0, 0.01);
}

TEST(FibreStrain, OfABentCantileverIsThatOfItsRoot) {
  const double load = 0.02 * Cantilever::kStiffness / (Cantilever::kLength * Cantilever::kLength);
  const double at_root = load * Cantilever::kLength * 0.5 / Cantilever::kStiffness;  // M h / 2 EI
  for (const int elements : {1, 2, 3, 8}) {
    const Sample last =
        scenes::run_frame(scenes::in_double_precision(Cantilever::spec(elements, Component::y, load, 0.2, 1.0))).back();
    scenes::record_bound("error at the root", last.largest_fibre_strain / at_root - 1.0, 2e-3);
  }
}

// The end of a cantilever is turned to four times the curvature at which it yields.
TEST(FibreStrain, OfABarThatHardensInEvenBendingIsThatOfItsCurvature) {
  constexpr double kYieldCurvature = PlasticFrame::kYieldMoment / PlasticFrame::kStiffness;
  FrameLattice frame = scenes::bar(PlasticFrame::kLength, PlasticFrame::kThickness, 8);
  frame.supports = {{0, true, true, true}};
  const double end = 60.0 * 2.0 * std::numbers::pi / PlasticFrame::frequency();
  frame.motions = {{1, Component::rotation, {{0.0, 0.0}, {end, 4.0 * kYieldCurvature * PlasticFrame::kLength}}}};
  frame.end_time_s = end;
  frame.watched_nodes = {1};
  SceneSpec spec = scenes::plastic_frame(std::move(frame), PlasticFrame::kModulus, PlasticFrame::kYieldStress);
  spec.material.hardening_modulus_mpa = PlasticFrame::kModulus / 9.0;
  spec.numerics.mass_damping_per_s = 0.4 * PlasticFrame::frequency();
  spec.output.sample_count = 100;
  double worst = 0.0;
  for (const Sample& sample : scenes::run_frame(spec)) {
    const double curvature = std::abs(sample.watched.front().rotation) / PlasticFrame::kLength;
    const double exact = 0.5 * PlasticFrame::kThickness * curvature;
    if (curvature > 0.5 * kYieldCurvature) worst = std::max(worst, std::abs(sample.largest_fibre_strain / exact - 1.0));
  }
  scenes::record_bound("error in even plastic bending", worst, 0.02);
}

// Perfectly plastic: all of the turn is at the clamped end.
TEST(FibreStrain, OfAHingeIsThatOfItsElementAndSoGrowsWithTheElements) {
  const auto strain_with = [](int elements) {
    return scenes::run_frame(scenes::pushed_cantilever(20.0, elements)).back().largest_fibre_strain;
  };
  const double coarse = strain_with(8);
  const double fine = strain_with(16);
  EXPECT_GT(coarse, 10.0 * PlasticFrame::kYieldStress / PlasticFrame::kModulus);
  EXPECT_NEAR(fine / coarse, 2.0, 0.3);
}

TEST(FibreStrain, OfACrushIsTheLargestOfItsFramesAndSummarized) {
  SceneSpec spec = scenes::hexagon_specimen(6, 5);
  spec.loading.end_strain = 0.1;
  spec.output.sample_count = 20;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  const std::vector<Sample> samples = scenes::run_to_end(simulation);
  const FieldFrame frame = simulation.take_frame(1);
  ASSERT_EQ(frame.fibre_strain.size(), scene->wall_count());
  const auto most = std::ranges::max_element(frame.fibre_strain);
  EXPECT_FLOAT_EQ(*most, static_cast<float>(samples.back().largest_fibre_strain));
  EXPECT_EQ(frame.fibre_strain[static_cast<std::size_t>(samples.back().most_strained_wall)], *most);
  EXPECT_GT(*most, 0.01);

  const Summary summary = summarize(*scene, samples);
  ASSERT_TRUE(summary.fibre_strain);
  const auto largest = std::ranges::max_element(samples, {}, &Sample::largest_fibre_strain);
  EXPECT_EQ(summary.fibre_strain->largest, largest->largest_fibre_strain);
  EXPECT_EQ(summary.fibre_strain->strain, largest->strain);
  const MeshView mesh = mesh_of(*scene);
  const auto element = std::ranges::find(mesh.element_wall, static_cast<int>(summary.fibre_strain->wall));
  ASSERT_NE(element, mesh.element_wall.end());
  const Vector2 middle(summary.fibre_strain->x, summary.fibre_strain->y);
  const auto& of_wall = scene->elements[static_cast<std::size_t>(element - mesh.element_wall.begin())];
  EXPECT_LT((scene->position[of_wall.start] - middle).norm(), 0.51 * 4.0) << "its wall is 4 mm long";
}

}  // namespace
}  // namespace cellcrush::fibre_strains
