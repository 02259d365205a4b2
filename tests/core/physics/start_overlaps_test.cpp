// Walls that overlap before loading (E8f): they start without force or energy, push when they come closer than they
// stand, and after they have parted as all walls do.
#include "contact/start_overlaps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "cellcrush/spec_checker.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"
#include "scenes/voronoi.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A raw foam of few cells and a relative density of 0.2 between the plates, with contact.
SceneSpec raw_foam(std::uint64_t seed, int elements_per_wall) {
  SceneSpec spec = scenes::hexagon_specimen(8, 7);
  spec.imperfection = {};
  FrameWalls foam = scenes::voronoi_foam(30.0, 20.0, 30, 0.2, seed);
  foam.self_contact = true;
  spec.lattice = foam;
  spec.elements_per_wall = elements_per_wall;
  spec.loading.speed_m_per_s = 100.0;
  spec.loading.end_strain = 0.6;
  return spec;
}

/// Nothing pushes, and nothing is stored.
void expect_no_force(const State& state) {
  EXPECT_EQ(state.contact_totals.count, 0);
  EXPECT_EQ(state.contact_totals.stored, 0.0);
  for (const ContactForce& force : state.contact_force) {
    ASSERT_TRUE(force.elastic.isZero(0.0) && force.viscous.isZero(0.0));
  }
}

TEST(StartOverlaps, OfFiveRawFoamsAreAcceptedWithoutForceAndTold) {
  for (const std::uint64_t seed : {3, 4, 5, 8, 9}) {
    const SceneSpec spec = raw_foam(seed, 8);
    EXPECT_TRUE(SpecChecker().check(spec).problems.empty()) << seed;
    const auto scene = scenes::build(spec);
    ASSERT_TRUE(scene);
    const std::size_t count = scene->start_overlaps.walls().size();
    EXPECT_GE(count, 2u) << seed;
    EXPECT_LE(count, 5u) << seed;
    expect_no_force(make_initial_state(*scene));
    const std::vector<int> drawn = mesh_of(*scene).overlap_particle;
    EXPECT_GE(drawn.size(), count) << seed;
    EXPECT_TRUE(std::ranges::is_sorted(drawn));
    EXPECT_THAT(facts_of(*scene).modelled,
                Contains(HasSubstr("Overlaps before loading: " + std::to_string(count) + " pairs")));
  }
  EXPECT_THAT(facts_of(*scenes::build(scenes::hexagon_specimen(4, 3))).modelled,
              Not(Contains(HasSubstr("Overlaps before"))));
}

TEST(StartOverlaps, LeaveTheLedgerOfAFoamClosed) {
  Simulation simulation(scenes::build(raw_foam(12, 4)));
  const Sample first = simulation.take_sample();
  EXPECT_EQ(first.energies.contact, 0.0);
  EXPECT_EQ(first.energies.external, 0.0);
  // The plate touches to round-off.
  EXPECT_LT(first.energies.elastic + first.energies.kinetic, 1e-20);
  const std::vector<Sample> samples = scenes::run_to_end(simulation);
  const Sample& last = samples.back();
  EXPECT_GT(last.strain, 0.59);
  const double error = std::abs(last.energies.residual) / last.energies.external;
  scenes::record_bound("ledger error in %", 100.0 * error, 0.1);
  const auto parted = std::ranges::count(simulation.state().parted, 1);
  EXPECT_GT(parted, 0);
  EXPECT_EQ(summarize(simulation.scene(), samples).start_overlap_count,
            std::ssize(simulation.scene().start_overlaps.walls()));
  EXPECT_GT(simulation.state().contact_totals.count, 0);
}

TEST(StartOverlaps, GiveTheSameBitsForAnyThreadsAndAfterACheckpoint) {
  const auto scene = scenes::build(raw_foam(12, 4));
  constexpr int kSteps = 7000;
  Simulation one(scene, 1);
  Simulation three(scene, 3);
  one.advance(kSteps);
  three.advance(kSteps);
  ASSERT_GT(std::ranges::count(one.state().parted, 1), 0);
  ASSERT_LT(std::ranges::count(one.state().parted, 1), std::ssize(one.state().parted));
  EXPECT_EQ(scenes::hash_of(one.state()), scenes::hash_of(three.state()));
  Simulation half(scene, 2);
  half.advance(kSteps / 2 + 3);  // between two looks for parted walls
  const std::string checkpoint = scenes::checkpoint_of(half);
  Simulation resumed(scene, 1);
  ASSERT_TRUE(resumed.restore(source_of(checkpoint)));
  EXPECT_EQ(resumed.state().parted, half.state().parted);
  resumed.advance(kSteps - kSteps / 2 - 3);
  EXPECT_EQ(scenes::hash_of(resumed.state()), scenes::hash_of(one.state()));
}

/// Two foils 1 mm thick, `apart` mm apart, one element each. The lower one is held; the upper one is moved up and down
/// to heights (mm) above the lower one, a millisecond each.
SceneSpec two_foils(double apart, const std::vector<double>& heights) {
  FrameLattice frame =
      scenes::touching_beams({{-40.0, 0.0}, {40.0, 0.0}, {-5.0, apart}, {5.0, apart}}, {{0, 1}, {2, 3}}, 1.0, 1);
  frame.supports = {{0, true, true, true}, {1, true, true, true}};
  FrameLattice::TimeFunction way = {{0.0, 0.0}};
  for (const double height : heights) way.emplace_back(way.back().first + 1e-3, height - apart);
  for (const int node : {2, 3}) {
    frame.motions.push_back({node, FrameLattice::Component::y, way});
    frame.motions.push_back({node, FrameLattice::Component::x, {{0.0, 0.0}}});
  }
  frame.end_time_s = way.back().first;
  SceneSpec spec = scenes::elastic_frame(std::move(frame));
  spec.contact.damping_ratio = 0.0;
  return spec;
}

TEST(StartOverlaps, OfTwoFoilsPushWhenCloserAndAfterPartingFromTheWholeThickness) {
  const double apart = 0.98;
  const auto scene = scenes::build(two_foils(apart, {0.95, apart, 1.02, 0.95}));
  EXPECT_EQ(scene->start_overlaps.pairs.size(), 2u);
  EXPECT_EQ(scene->start_overlaps.walls(), (std::vector<std::pair<int, int>>{{0, 1}}));
  Simulation simulation(scene);
  expect_no_force(simulation.state());
  const auto force_at = [&](double time) {
    while (simulation.state().time < time) simulation.advance(1);
    return simulation.state().contact_force[2].elastic.y() / scene->contact.stiffness;
  };
  const auto height = [&] { return simulation.state().position[2].y() - simulation.state().position[0].y(); };
  const auto parted = [&] { return std::ranges::count(simulation.state().parted, 1); };
  const double pressed = force_at(0.9e-3);
  EXPECT_NEAR(pressed, apart - height(), 1e-5);
  EXPECT_GT(pressed, 0.02);
  EXPECT_EQ(force_at(2.2e-3), 0.0);  // between 0.98 and 1: not yet parted
  EXPECT_LT(height(), 1.0);
  EXPECT_EQ(parted(), 0);
  EXPECT_EQ(force_at(2.9e-3), 0.0);
  EXPECT_EQ(parted(), 2);
  for (const double time : {3.6e-3, 3.9e-3}) {
    const double again = force_at(time);
    EXPECT_LT(height(), apart);
    EXPECT_NEAR(again, 1.0 - height(), 1e-9);
  }
}

/// A ring of radius 10 mm that four ligaments leave along it.
SceneSpec ring_with_tangential_ligaments() {
  constexpr int kCorners = 24;
  constexpr double kRadius = 10.0;
  std::vector<Vector2> nodes;
  std::vector<std::pair<int, int>> beams;
  for (int i = 0; i < kCorners; ++i) {
    nodes.push_back(kRadius * scenes::direction(2.0 * std::numbers::pi * i / kCorners));
    beams.emplace_back(i, (i + 1) % kCorners);
  }
  for (int i = 0; i < kCorners; i += kCorners / 4) {
    const Vector2 out = nodes[i] / kRadius;
    beams.emplace_back(i, static_cast<int>(nodes.size()));
    nodes.push_back(nodes[i] + 15.0 * Vector2(-out.y(), out.x()));
  }
  FrameLattice frame = scenes::touching_beams(nodes, beams, 1.0, 4);
  for (const int end : {kCorners, kCorners + 2}) frame.supports.push_back({end, true, true, true});
  frame.motions.push_back({kCorners + 1, FrameLattice::Component::x, {{0.0, 0.0}, {2e-3, 20.0}}});
  frame.motions.push_back({kCorners + 3, FrameLattice::Component::x, {{0.0, 0.0}, {2e-3, -20.0}}});
  frame.end_time_s = 2e-3;
  return scenes::plastic_frame(std::move(frame), 70000.0, 300.0, scenes::kDensity);
}

// The ligaments wind the ring up: they part from it on one side and lie down on it on the other.
TEST(StartOverlaps, OfTangentialLigamentsLetThemUnwindWithAClosedLedger) {
  const auto scene = scenes::build(ring_with_tangential_ligaments());
  ASSERT_TRUE(scene);
  EXPECT_GE(scene->start_overlaps.walls().size(), 4u);
  Simulation simulation(scene);
  expect_no_force(simulation.state());
  const Sample last = scenes::run_to_end(simulation).back();
  EXPECT_GT(std::ranges::count(simulation.state().parted, 1), 0);
  EXPECT_GT(last.energies.external, 0.0);
  scenes::record_bound("ledger error in %", 100.0 * std::abs(last.energies.residual) / last.energies.external, 1.0);
}

/// A ring with a sharp corner that is opened and then closed.
SceneSpec sharp_ring() {
  FrameLattice frame = scenes::touching_beams({{0.0, 0.0}, {20.0, 2.5}, {26.0, 0.0}, {20.0, -2.5}},
                                              {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, 1.0, 8);
  for (const int node : {1, 3}) {
    const double way = node == 1 ? 1.0 : -1.0;
    frame.motions.push_back({node, FrameLattice::Component::y, {{0.0, 0.0}, {1e-3, 4.0 * way}, {2.5e-3, -1.8 * way}}});
  }
  frame.end_time_s = 2.5e-3;
  return scenes::elastic_frame(std::move(frame));
}

TEST(StartOverlaps, AreTheSameForBothSearches) {
  const auto run = [](ContactSpec::Search search) {
    SceneSpec spec = sharp_ring();
    spec.contact.search = search;
    const auto scene = scenes::build(spec);
    EXPECT_THAT(scene->start_overlaps.walls(), Contains(std::pair(0, 3)));
    EXPECT_EQ(scene->faces.are_enough(), search == ContactSpec::Search::faces);
    Simulation simulation(scene);
    expect_no_force(simulation.state());
    const Sample last = scenes::run_to_end(simulation).back();
    EXPECT_LT(std::abs(last.energies.residual), 1e-3 * last.energies.external);
    return simulation.state();
  };
  const State by_faces = run(ContactSpec::Search::faces);
  const State by_buckets = run(ContactSpec::Search::buckets);
  EXPECT_GT(std::ranges::count(by_faces.parted, 1), 0);
  EXPECT_GT(by_faces.contact_totals.count, 0);
  EXPECT_EQ(by_faces.parted, by_buckets.parted);
  EXPECT_EQ(by_faces.position, by_buckets.position);
}

}  // namespace
}  // namespace cellcrush
