#include "contact/bucket_grid.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "contact/capsule.h"
#include "contact/find_contacts.h"
#include "scenes/frames.h"
#include "step/advance_step.h"
#include "step/integrate_motion.h"

namespace cellcrush {
namespace {

TEST(BucketGrid, FindsWhatBruteForceFindsAtNegativeCoordinatesToo) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> place(-30.0, 20.0);
  std::vector<Vector2> points;
  for (int i = 0; i < 2000; ++i) {
    points.emplace_back(place(generator), place(generator));
  }
  const BucketGrid grid(points, 1.3);
  for (int query = 0; query < 300; ++query) {
    const Vector2 low(place(generator) - 5.0, place(generator) - 5.0);
    const Vector2 high = low + Vector2(3.0, 2.0);
    std::set<int> found;
    grid.visit_box(low, high, [&](int i) { found.insert(i); });
    for (int i = 0; i < 2000; ++i) {
      const bool inside = (points[i].array() >= low.array()).all() && (points[i].array() <= high.array()).all();
      EXPECT_TRUE(!inside || found.count(i) == 1);
    }
    EXPECT_LT(found.size(), 40u);  // a few buckets, not the whole
  }
}

TEST(BucketGrid, AParticleThrownFarAwayCostsNoMemory) {
  std::vector<Vector2> points(100, Vector2(0.0, 0.0));
  points.emplace_back(1e9, -1e9);
  const BucketGrid grid(points, 0.5);
  int found = 0;
  grid.visit_box({-1.0, -1.0}, {1.0, 1.0}, [&](int) { ++found; });
  EXPECT_EQ(found, 100);
  EXPECT_GT(grid.bucket_size(), 1e7);
}

// The list must hold every pair closer than touch and skin, and no ball against its own elements.
TEST(ContactSearch, AgreesWithBruteForceOnAShakenLattice) {
  const auto scene = scenes::build(scenes::hexagon_block(6, 5));
  State state = make_initial_state(*scene);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> shake(-1.2, 1.2);
  for (Vector2& position : state.position) {
    position = Vector2(0.4, 1.0).cwiseProduct(position) + Vector2(shake(generator) - 20.0, shake(generator) - 20.0);
  }
  for (std::size_t e = 0; e < scene->element_count(); ++e) {
    const Vector2 span = state.position[scene->elements[e].end] - state.position[scene->elements[e].start];
    state.length[e] = span.norm();
    state.axis[e] = span / state.length[e];
  }
  search_contacts(*scene, state);
  std::set<std::pair<int, int>> listed;
  for (int ball = 0; ball < static_cast<int>(scene->particle_count()); ++ball) {
    for (int k = state.candidate_offset[ball]; k < state.candidate_offset[ball + 1]; ++k) {
      EXPECT_TRUE(listed.emplace(ball, state.candidates[k].segment).second);
    }
  }
  std::set<std::pair<int, int>> near;
  for (int ball = 0; ball < static_cast<int>(scene->particle_count()); ++ball) {
    for (int e = 0; e < static_cast<int>(scene->element_count()); ++e) {
      const Element& element = scene->elements[e];
      const Projection foot =
          project(state.position[ball], state.position[element.start], state.axis[e], state.length[e]);
      if (ball != element.start && ball != element.end &&
          foot.offset.norm() < scene->radius[ball] + 0.5 * element.thickness + scene->contact.skin) {
        near.emplace(ball, e);
      }
    }
  }
  EXPECT_GT(near.size(), 200u);
  EXPECT_EQ(listed, near);
}

TEST(ContactSearch, CandidatesAParticleDoNotGrowWithTheLattice) {
  const auto candidates_a_particle = [](int columns, int rows) {
    SceneSpec spec = scenes::hexagon_block(columns, rows);
    spec.loading.end_strain = 0.6;
    spec.loading.speed_m_per_s = 200.0;
    const auto scene = scenes::build(spec);
    Simulation simulation(scene);
    simulation.advance(scene->schedule.step_count);
    return static_cast<double>(simulation.state().candidates.size()) / static_cast<double>(scene->particle_count());
  };
  const double small = candidates_a_particle(10, 4);
  const double large = candidates_a_particle(20, 8);
  EXPECT_GT(small, 1.0);
  EXPECT_LT(large, 12.0);
  EXPECT_LT(large / small, 1.4);
}

}  // namespace
}  // namespace cellcrush
