// Steps of a large lattice, which is cut into bands, advanced in wavefronts.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "contact/contact_search.h"
#include "measure/sampler.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/near_pairs.h"
#include "scenes/state_hash.h"
#include "step/advance_step.h"
#include "step/advance_wavefront.h"
#include "step/stages.h"

namespace cellcrush {
namespace {

constexpr int kCrushedSteps = 700;

/// Large enough to be cut, and so short that walls touch within the steps that are run.
SceneSpec wide_specimen() {
  SceneSpec spec = scenes::with_the_papers_elements(scenes::hexagon_specimen(10, 1000));
  spec.imperfection = {0.01, 1};
  return spec;
}

std::uint64_t crush_in_wavefronts(const Scene& scene, int threads, int piece, int steps = kCrushedSteps) {
  State state = make_initial_state(scene);
  Workspace workspace(threads);
  for (int done = 0; done < steps; done += piece) {
    advance_steps(scene, state, workspace, std::min(piece, steps - done), nullptr);
    EXPECT_TRUE(can_advance_wavefronts(scene, state));
  }
  return scenes::hash_of(state);
}

/// The stages of each step, in the order in which they first begin.
class StageOrders : public StageObserver {
 public:
  void begin(Stage stage) override {
    if (std::ranges::find(order_, stage) == order_.end()) {
      order_.push_back(stage);
    }
  }
  void end_step() override { orders_.push_back(std::exchange(order_, {})); }
  [[nodiscard]] const std::vector<std::vector<Stage>>& orders() const { return orders_; }

 private:
  std::vector<Stage> order_;
  std::vector<std::vector<Stage>> orders_;
};

TEST(Wavefront, GiveTheBitsOfSingleStepsWhateverTheirLengthAndTheThreads) {
  const auto scene = scenes::build(wide_specimen());
  ASSERT_GT(scene->bands.size(), 1u);
  ASSERT_TRUE(use_simd_target("scalar"));
  EXPECT_EQ(crush_in_wavefronts(*scene, 2, 13, 100), scenes::hash_of(scenes::state_after(*scene, 100)));
  ASSERT_TRUE(use_simd_target(""));
  const State state = scenes::state_after(*scene, kCrushedSteps);
  ASSERT_GT(state.contact_totals.count, 300);
  const std::uint64_t expected = scenes::hash_of(state);
  for (const auto& [threads, piece] : std::vector<std::pair<int, int>>{{1, 20}, {1, 7}, {1, 1}, {2, 20}, {3, 13}}) {
    EXPECT_EQ(crush_in_wavefronts(*scene, threads, piece), expected) << threads << " threads, pieces of " << piece;
  }
}

// One list of stages (step/stages.h), whichever executor runs it. No stage but the last is for the whole alone.
TEST(Wavefront, TakeTheStagesInTheOrderOfPlainAndOverlappedSteps) {
  std::vector<Stage> expected;
  for (const StageEntry& entry : kStages) {
    expected.push_back(entry.stage);
  }
  const auto small = scenes::build(scenes::hexagon_specimen(3, 2));
  for (const int threads : {1, 2}) {
    StageOrders observer;
    Simulation(small, threads).advance(2, &observer);
    EXPECT_EQ(observer.orders(), std::vector(2, expected)) << threads << " threads";
  }
  const auto wide = scenes::build(wide_specimen());
  StageOrders observer;
  Simulation(wide, 1).advance(3, &observer);
  expected.pop_back();
  EXPECT_EQ(observer.orders(), std::vector(1, expected));
}

// Bands do not pay on small lattices, and friction is handed over between balls of two bands.
TEST(Wavefront, AreLeftOutWhereTheyDoNotPayOrAreNotEnough) {
  SceneSpec rubbing = wide_specimen();
  rubbing.contact.friction = 0.2;
  SceneSpec by_buckets = wide_specimen();
  by_buckets.contact.search = ContactSpec::Search::buckets;
  for (const SceneSpec& spec : {scenes::hexagon_specimen(12, 5), rubbing, by_buckets}) {
    EXPECT_EQ(scenes::build(spec)->bands.size(), 1u);
  }
}

// Lattices long in the crush are numbered by columns.
TEST(Wavefront, GiveThemOfEveryKindOfWallsAndLattices) {
  SceneSpec damped = wide_specimen();
  damped.numerics.mass_damping_per_s = 500.0;
  damped.plates.friction = 0.2;
  SceneSpec hardening = wide_specimen();
  hardening.material.hardening_modulus_mpa = 100.0;
  SceneSpec force_based = wide_specimen();
  force_based.section = {};
  SceneSpec precise = wide_specimen();
  precise.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  const SceneSpec of_columns = scenes::with_the_papers_elements(scenes::hexagon_specimen(600, 17));
  SceneSpec squares = wide_specimen();
  squares.lattice = scenes::squares(12, 1500, 4.0, 0.3);
  squares.elements_per_wall = 2;
  SceneSpec triangles = wide_specimen();
  triangles.lattice = scenes::triangles(10, 1000, 4.0, 0.2);
  triangles.elements_per_wall = 2;
  for (const SceneSpec& spec : {damped, hardening, force_based, precise, of_columns, squares, triangles}) {
    const auto scene = scenes::build(spec);
    ASSERT_GT(scene->bands.size(), 10u);
    const std::uint64_t expected = scenes::hash_of(scenes::state_after(*scene, 150));
    EXPECT_EQ(crush_in_wavefronts(*scene, 1, 150, 150), expected);
    EXPECT_EQ(crush_in_wavefronts(*scene, 2, 150, 150), expected);
  }
}

/// The same with thick ends (contact/topology/face_loops.h), which meet as the cells close along y.
SceneSpec wide_specimen_of_thick_ends() {
  SceneSpec spec = scenes::with_the_papers_elements(scenes::hexagon_specimen(1000, 10));
  auto& hexagon = scenes::cells_of(spec);
  hexagon.wall_thickness_mm = 0.5;
  hexagon.own["vertical_wall_thickness_mm"] = 0.9;
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.imperfection = {0.01, 1};
  return spec;
}

// The search by buckets does without bands. Forces on a particle are added in another order: the last bits differ.
void expect_the_touches_of_the_buckets(SceneSpec spec, const std::string& distance_name) {
  constexpr int steps = kCrushedSteps;
  const auto banded = scenes::build(spec);
  ASSERT_GT(banded->bands.size(), 1u);
  spec.contact.search = ContactSpec::Search::buckets;
  const auto whole = scenes::build(spec);
  State state = make_initial_state(*banded);
  Workspace workspace;
  advance_steps(*banded, state, workspace, steps, nullptr);
  const State reference = scenes::state_after(*whole, steps);
  EXPECT_GT(state.contact_totals.count, 300);
  EXPECT_EQ(state.contact_totals.count, reference.contact_totals.count);
  const double difference = scenes::distance_between(state, reference);
  scenes::record_bound(distance_name, difference, 1e-7);
  EXPECT_NEAR(state.ledger.contact, reference.ledger.contact, 1e-6 * reference.ledger.external);
  EXPECT_NEAR(state.ledger.plastic, reference.ledger.plastic, 1e-6 * reference.ledger.external);
}

TEST(Wavefront, TouchWhatTheBucketsDo) { expect_the_touches_of_the_buckets(wide_specimen(), "distance in mm"); }

TEST(Wavefront, TouchThickEndsAsTheBucketsDo) {
  expect_the_touches_of_the_buckets(wide_specimen_of_thick_ends(), "distance of thick ends in mm");
}

TEST(Wavefront, GoOnFromACheckpoint) {
  const auto scene = scenes::build(wide_specimen());
  Simulation whole(scene);
  whole.advance(200);
  Simulation resumed(scene, 2);
  ASSERT_TRUE(resumed.restore(source_of(scenes::checkpoint_of(whole))));
  whole.advance(200);
  resumed.advance(200);
  EXPECT_EQ(scenes::hash_of(resumed.state()), scenes::hash_of(whole.state()));
  EXPECT_EQ(crush_in_wavefronts(*scene, 1, 400, 400), scenes::hash_of(whole.state()));
}

/// A joint in the middle of the lattice.
int inner_joint(const Scene& scene) {
  const Vector2 middle = 0.5 * (scene.position[0] + scene.position[scene.joint_count - 1]);
  const auto last = scene.position.begin() + scene.joint_count;
  const auto nearest = std::ranges::min_element(scene.position.begin(), last, {},
                                                [&](const Vector2& place) { return (place - middle).norm(); });
  return static_cast<int>(nearest - scene.position.begin());
}

// A joint is thrown through the wall behind it: no penalty stops 30 km/s.
TEST(Wavefront, GoOverToBucketsWhenAWallHasCrossedAnother) {
  const auto scene = scenes::build(wide_specimen());
  State state = make_initial_state(*scene);
  Workspace workspace;
  advance_steps(*scene, state, workspace, 20, nullptr);
  state.velocity[inner_joint(*scene)] = Vector2(3e7, 1e6);
  advance_steps(*scene, state, workspace, 20, nullptr);
  ASSERT_GT(state.crossing_step, 20);
  EXPECT_FALSE(can_advance_wavefronts(*scene, state));
  EXPECT_EQ(state.contacts.size(), scene->bands.size());
  advance_step(*scene, state, workspace, nullptr);
  EXPECT_GT(state.contacts.front().search_count, 0);
  const scenes::Pairs listed = scenes::listed_pairs(state);
  for (const scenes::Overlap& overlap : scenes::overlaps_by_buckets(*scene, state)) {
    EXPECT_EQ(listed.count({overlap.ball, overlap.segment}), 1u);
  }
}

/// A particle of the left side of a band.
int left_of(const Scene& scene, int band) {
  return *std::ranges::min_element(scene.faces.bands[band].particle, {},
                                   [&](int particle) { return scene.position[particle].x(); });
}

/// Draws a particle of the left side of one band and one of another band far to the left, beside each other, so that no
/// walls cross.
void draw_borders_together(const Scene& scene, State& state) {
  Vector2& place = state.position[left_of(scene, 5)];
  Vector2& other = state.position[left_of(scene, 15)];
  const double middle = 0.5 * (place.y() + other.y());
  const double side = place.y() < other.y() ? 1.0 : -1.0;
  place = {-1e3, middle - 0.05 * side};
  other = {-1e3, middle + 0.05 * side};
}

TEST(Wavefront, GoOverToBucketsWhenBordersComeNearEachOtherAndTellSoOnce) {
  const auto scene = scenes::build(wide_specimen());
  State state = make_initial_state(*scene);
  Workspace workspace;
  Sampler sampler(*scene);
  const auto take = [&] { return sampler.take({*scene, state, *scene, state}, workspace.shared.workers); };
  advance_steps(*scene, state, workspace, 20, nullptr);
  EXPECT_TRUE(can_advance_wavefronts(*scene, state));
  EXPECT_TRUE(take().warnings.empty());
  draw_borders_together(*scene, state);
  advance_steps(*scene, state, workspace, 1, nullptr);
  EXPECT_LT(state.crossing_step, 0);
  EXPECT_FALSE(can_advance_wavefronts(*scene, state));
  const auto tells_so = [](const Sample& sample) {
    return std::ranges::count(sample.warnings, Warning::Kind::borders_near, &Warning::kind);
  };
  EXPECT_EQ(tells_so(take()), 1);
  EXPECT_EQ(tells_so(take()), 0);
}

// A crush presses bands that follow each other along it together. Bands of four columns, the smallest, are near each
// other at 3 % strain.
TEST(Wavefront, BandsAlongTheCrushAreSoDeepThatTheyStayApart) {
  SceneSpec spec = scenes::with_the_papers_elements(scenes::hexagon_specimen(180, 48));
  spec.imperfection = {0.01, 1};
  const auto scene = scenes::build(spec);
  ASSERT_GT(scene->bands.size(), 1u);
  State state = make_initial_state(*scene);
  Workspace workspace;
  while (state.impact_travel < 0.06 * scene->length) advance_steps(*scene, state, workspace, 100, nullptr);
  EXPECT_TRUE(can_advance_wavefronts(*scene, state));
}

}  // namespace
}  // namespace cellcrush
