#include "bench/state_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "scenes/frames.h"
#include "scenes/state_hash.h"
#include "step/advance_step.h"

namespace cellcrush::bench {
namespace {

namespace fs = std::filesystem;

class StateFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "cellcrush-bench-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(StateFile, GivesBackAStateThatStepsOnWithTheSameBits) {
  const auto scene = scenes::build(scenes::hexagon_specimen(6, 4));
  Simulation simulation(scene);
  simulation.advance(2000);
  State state = simulation.state();
  ASSERT_GT(state.contact_totals.count, 0);
  save_state(folder_ / "kept" / "a.state", state);
  std::optional<State> loaded = load_state(folder_ / "kept" / "a.state");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(scenes::hash_of(*loaded), scenes::hash_of(state));
  for (int i = 0; i < 50; ++i) {
    advance_step(*scene, state, nullptr);
    advance_step(*scene, *loaded, nullptr);
  }
  EXPECT_EQ(scenes::hash_of(*loaded), scenes::hash_of(state));
}

TEST_F(StateFile, ThatIsMissingIsNothingAndOneThatIsCutShortIsRefused) {
  EXPECT_FALSE(load_state(folder_ / "none.state"));
  std::ofstream(folder_ / "short.state") << "1234";
  EXPECT_THROW(load_state(folder_ / "short.state"), std::runtime_error);
}

}  // namespace
}  // namespace cellcrush::bench
