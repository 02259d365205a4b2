// What the motion is told of contacts, and what it notes for the plates.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cellcrush/simd.h"
#include "contact/contact_tiles.h"
#include "motion/integrate_motion.h"
#include "push/push.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"
#include "step/advance_step.h"
#include "step/workspace.h"

namespace cellcrush {
namespace {

SceneSpec specimen() {
  SceneSpec spec = scenes::with_the_papers_elements(scenes::hexagon_specimen(12, 5));
  spec.imperfection = {0.01, 1};
  return spec;
}

TEST(ContactTiles, SpareParticlesAndWithoutThemTheBitsAreTheSame) {
  const auto scene = scenes::build(specimen());
  State state = make_initial_state(*scene);
  Workspace workspace;
  for (int step = 0; step < 1030; ++step) {
    advance_step(*scene, state, workspace, nullptr);
  }
  State forgetful = state;
  for (int step = 0; step < 50; ++step) {
    advance_step(*scene, state, workspace, nullptr);
    forgetful.contact_tiles.clear();
    advance_step(*scene, forgetful, workspace, nullptr);
  }
  EXPECT_GT(state.contact_totals.count, 0);
  EXPECT_EQ(scenes::hash_of(forgetful), scenes::hash_of(state));
  std::size_t spared = 0;
  for (std::size_t i = 0; i < scene->particle_count(); ++i) {
    spared += may_bear_contact(state.contact_tiles.data(), i, 1) ? 0 : 1;
  }
  EXPECT_GT(spared, 0u);
}

/// Particles that a plate may act on, one by one.
std::vector<int> near_plates_of(const Scene& scene, const State& state) {
  std::vector<int> near;
  const double impact = scene.plates.impact_face + state.impact_travel;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const double place = state.position[i][scene.plates.axis];
    const bool rubs =
        !state.impact_friction.empty() && (state.impact_friction[i] != 0.0 || state.support_friction[i] != 0.0);
    if (place - scene.radius[i] < impact || place + scene.radius[i] > scene.plates.support_face || rubs) {
      near.push_back(static_cast<int>(i));
    }
  }
  return near;
}

/// Moves the particles by a step, and returns those that the motion notes as near a plate.
std::vector<int> move_and_note(const Scene& scene, State& state, Workspace& workspace) {
  const PlateStep plates = plate_step_of(scene, state.time, state.impact_travel);
  std::vector<MovedChunk> moved(moved_chunk_count(scene));
  std::vector<int> noted(scene.particle_count());
  const LatticeBand& band = scene.bands.front();
  const NearCounts counts = integrate_motion(scene, state, band, plates.reach, workspace.shared.workers, moved, noted);
  state.impact_travel = plates.travel;
  std::vector<int> near(noted.begin(), noted.begin() + static_cast<std::ptrdiff_t>(counts.joints));
  near.insert(near.end(), noted.begin() + band.first_inner,
              noted.begin() + band.first_inner + static_cast<std::ptrdiff_t>(counts.inner));
  return near;
}

TEST(NearPlates, HoldAllThatReachOneOrRubAndAreAscending) {
  SceneSpec rough = specimen();
  rough.plates.friction = 0.3;
  SceneSpec across = specimen();
  across.loading.direction = LoadingSpec::Direction::y;
  for (const SceneSpec& spec : {specimen(), rough, across}) {
    const auto scene = scenes::build(spec);
    ASSERT_TRUE(scene);
    for (const std::string& target : simd_targets()) {
      ASSERT_TRUE(use_simd_target(target));
      State state = make_initial_state(*scene);
      Workspace workspace;
      std::size_t reached = 0;
      for (int step = 0; step < 200; ++step) {
        State moved = state;
        const std::vector<int> near = move_and_note(*scene, moved, workspace);
        ASSERT_TRUE(std::is_sorted(near.begin(), near.end()));
        const std::vector<int> all = near_plates_of(*scene, moved);
        reached += all.size();
        ASSERT_TRUE(std::includes(near.begin(), near.end(), all.begin(), all.end())) << target << ", step " << step;
        ASSERT_LT(near.size(), scene->particle_count() / 2);
        advance_step(*scene, state, workspace, nullptr);
      }
      EXPECT_GT(reached, 0u) << target;
    }
  }
  ASSERT_TRUE(use_simd_target(""));
}

}  // namespace
}  // namespace cellcrush
