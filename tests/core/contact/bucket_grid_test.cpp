#include "geometry/bucket_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "contact/contact_search.h"
#include "contact/search/pair_search.h"
#include "motion/initial_state.h"
#include "scenes/frames.h"
#include "scenes/near_pairs.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

using scenes::listed_pairs;
using scenes::Pairs;

TEST(BucketGrid, AParticleThrownFarAwayCostsNoMemory) {
  std::vector<Vector2> points(100, Vector2(0.0, 0.0));
  points.emplace_back(1e9, -1e9);
  const BucketGrid grid(points, 0.5);
  int found = 0;
  grid.visit_box({-1.0, -1.0}, {1.0, 1.0}, [&](int) { ++found; });
  EXPECT_EQ(found, 100);
  EXPECT_GT(grid.bucket_size(), 1e7);
}

void search(const Scene& scene, State& state) {
  scenes::follow_positions(scene, state);
  list_by_buckets(scene, state, state.contacts.front());
}

Pairs near_pairs(const Scene& scene, const State& state) {
  return scenes::near_pairs(scene, state, scene.contact.skin);
}

// Two beams side by side; then an end of one is moved through the other.
TEST(ContactSearch, FindsThatAWallHasCrossedAnother) {
  FrameLattice frame;
  for (const Vector2& node : {Vector2(0, 0), Vector2(20, 0), Vector2(10, 2), Vector2(10, 20)}) {
    frame.nodes.push_back({node.x(), node.y(), 0.0, 0.0});
  }
  frame.beams = {scenes::beam(0, 1, 1.0, 1), scenes::beam(2, 3, 1.0, 1)};
  frame.self_contact = true;
  const auto scene = scenes::build(scenes::elastic_frame(frame));
  ASSERT_FALSE(scene->faces.are_enough());
  State state = make_initial_state(*scene);
  Workers workers(1);
  EXPECT_TRUE(list_by_buckets(*scene, state, state.contacts.front()));
  state.position[2] = {10.0, -0.5};
  scenes::follow_positions(*scene, state);
  EXPECT_FALSE(list_by_buckets(*scene, state, state.contacts.front()));
  find_contacts(*scene, state, workers);
  EXPECT_LT(state.crossing_step, 0) << "the list holds";
  state.position[2] = {10.0, 15.0};
  scenes::follow_positions(*scene, state);
  find_contacts(*scene, state, workers);
  EXPECT_LT(state.crossing_step, 0);
  state.position[2] = {10.0, -0.5};
  state.step = 7;
  scenes::follow_positions(*scene, state);
  find_contacts(*scene, state, workers);
  EXPECT_EQ(state.crossing_step, 7);
}

// Walls of a lattice thrown about at random: sparse and dense, round the origin and far from it, in a line, on one
// point.
TEST(ContactSearch, AgreesWithBruteForceOnRandomScenes) {
  const auto scene = scenes::build(scenes::hexagon_specimen(4, 4));
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  std::size_t most = 0;
  for (const Vector2& middle : {Vector2(0.0, 0.0), Vector2(-3e3, 7e2), Vector2(-1e6, -1e6)}) {
    for (const Vector2& spread : {Vector2(300.0, 300.0), Vector2(30.0, 30.0), Vector2(4.0, 4.0), Vector2(0.1, 0.1),
                                  Vector2(50.0, 0.0), Vector2(0.0, 20.0), Vector2(1e4, 1.0), Vector2(0.0, 0.0)}) {
      State state = place_particles(*scene);
      for (Vector2& position : state.position) {
        position = middle + spread.cwiseProduct(Vector2(even(generator), even(generator)));
      }
      search(*scene, state);
      const Pairs near = near_pairs(*scene, state);
      EXPECT_EQ(listed_pairs(state), near) << middle.transpose() << " spread " << spread.transpose();
      most = std::max(most, near.size());
    }
  }
  EXPECT_EQ(most, scene->element_count() * (scene->particle_count() - 2));  // on one point, all
}

// One particle flies away: the buckets must not grow with the distance, nor lose the rest.
TEST(ContactSearch, AgreesWithBruteForceWhenAParticleIsLost) {
  const auto scene = scenes::build(scenes::hexagon_specimen(4, 4));
  State state = place_particles(*scene);
  state.position[7] = {4e7, -2e7};
  search(*scene, state);
  EXPECT_EQ(listed_pairs(state), near_pairs(*scene, state));
}

TEST(ContactSearch, CandidatesAParticleDoNotGrowWithTheLattice) {
  const auto candidates_a_particle = [](int columns, int rows) {
    SceneSpec spec = scenes::hexagon_specimen(columns, rows);
    spec.loading.end_strain = 0.6;
    spec.loading.speed_m_per_s = 200.0;
    const auto scene = scenes::build(spec);
    Simulation simulation(scene);
    simulation.advance(scene->schedule.step_count);
    return static_cast<double>(simulation.state().contacts.front().candidate_count) /
           static_cast<double>(scene->particle_count());
  };
  const double small = candidates_a_particle(10, 4);
  const double large = candidates_a_particle(20, 8);
  EXPECT_GT(small, 0.5);
  EXPECT_LT(large, 12.0);
  EXPECT_LT(large / small, 1.4);
}

}  // namespace
}  // namespace cellcrush
