#include <gtest/gtest.h>

#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

/// A block whose walls touch within the steps that are run.
SceneSpec block() {
  SceneSpec spec = scenes::hexagon_block(20, 9);
  spec.imperfection = {0.01, 1};
  return spec;
}

SceneSpec with_friction_and_damping(SceneSpec spec) {
  spec.contact.friction = 0.2;
  spec.plates.friction = 0.2;
  spec.numerics.mass_damping_per_s = 1000.0;
  return spec;
}

TEST(Threads, AnyNumberOfThemGivesTheSameBits) {
  const std::pair<const char*, SceneSpec> cases[] = {
      {"default", block()},
      {"the paper's elements", scenes::with_the_papers_elements(block())},
      {"friction and damping", with_friction_and_damping(block())},
  };
  for (const std::string& target : {simd_target(), std::string("scalar")}) {
    ASSERT_TRUE(use_simd_target(target));
    for (const auto& [name, spec] : cases) {
      const auto scene = scenes::build(spec);
      const auto crush = [&](int threads) {
        Simulation simulation(scene, threads);
        simulation.advance(3000);
        EXPECT_GT(simulation.state().contact_count, 0) << name;
        return scenes::hash_of(simulation.state());
      };
      const auto one = crush(1);
      for (const int threads : {2, 3}) {
        EXPECT_EQ(crush(threads), one) << name << ", " << threads << " threads, " << target;
      }
    }
  }
  EXPECT_TRUE(use_simd_target(""));
}

}  // namespace
}  // namespace cellcrush
