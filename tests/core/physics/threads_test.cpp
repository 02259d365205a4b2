#include <gtest/gtest.h>

#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "cellcrush/tuning.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

/// A specimen whose walls touch within the steps that are run.
SceneSpec specimen() {
  SceneSpec spec = scenes::hexagon_specimen(12, 5);
  spec.imperfection = {0.01, 1};
  return spec;
}

SceneSpec with_friction_and_damping(SceneSpec spec) {
  spec.contact.friction = 0.2;
  spec.plates.friction = 0.2;
  spec.numerics.mass_damping_per_s = 1000.0;
  return spec;
}

/// Hash of the state after a crush that has closed some cells.
std::uint64_t hash_after_crush(const SceneSpec& spec, int threads) {
  Simulation simulation(scenes::build(spec), threads);
  simulation.advance(1000);
  EXPECT_GT(simulation.state().contact_totals.count, 0);
  return scenes::hash_of(simulation.state());
}

TEST(Threads, AnyNumberOfThemGivesTheSameBits) {
  for (const SceneSpec& spec :
       {specimen(), scenes::with_the_papers_elements(specimen()), with_friction_and_damping(specimen())}) {
    const std::uint64_t one = hash_after_crush(spec, 1);
    for (const int threads : {2, 3, 7}) {
      EXPECT_EQ(hash_after_crush(spec, threads), one) << threads;
    }
  }
}

// Where the contacts do not overlap with the walls.
TEST(Threads, AnyNumberOfThemGivesTheSameBitsOfALargeLattice) {
  const auto scene = scenes::build(scenes::with_the_papers_elements(scenes::hexagon_specimen(100, 40)));
  ASSERT_GT(scene->element_count(), kMostElementsOverlapped);
  const auto crush_some = [&scene](int threads) {
    Simulation simulation(scene, threads);
    simulation.advance(100);
    return scenes::hash_of(simulation.state());
  };
  const std::uint64_t one = crush_some(1);
  EXPECT_EQ(crush_some(2), one);
  EXPECT_EQ(crush_some(3), one);
}

TEST(Threads, AnyNumberOfThemGivesTheSameBitsOnTheScalarTarget) {
  ASSERT_TRUE(use_simd_target("scalar"));
  EXPECT_EQ(hash_after_crush(with_friction_and_damping(specimen()), 3),
            hash_after_crush(with_friction_and_damping(specimen()), 1));
  EXPECT_TRUE(use_simd_target(""));
}

}  // namespace
}  // namespace cellcrush
