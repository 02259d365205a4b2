// The bits of every preset's first steps, and of small whole crushes, on every target. They change only by a commit
// that says why.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "cellcrush/simulation.h"
#include "core/crush/golden_hashes.h"
#include "scenes/frames.h"
#include "scenes/presets.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

/// Set to rewrite the file.
constexpr const char* kRewrite = "CELLCRUSH_WRITE_HASHES";

/// Holds crushes to the file, or writes theirs into it.
void expect_recorded_bits_of(const std::vector<scenes::GoldenCrush>& crushes) {
  if (!scenes::is_processor_of_the_file()) {
    GTEST_SKIP() << "The recorded bits are those of processors with fused multiply-add.";
  }
  scenes::Hashes recorded = scenes::read_hashes();
  const scenes::Hashes found = scenes::hashes_of(crushes);
  if (std::getenv(kRewrite) != nullptr) {
    for (const auto& [key, hash] : found) {
      recorded[key] = hash;
    }
    scenes::write_hashes(recorded);
    return;
  }
  for (const auto& [key, hash] : found) {
    EXPECT_EQ(recorded[key], hash) << key << ": the bits have changed. If they were meant to, run this test with "
                                   << kRewrite << "=1 and say why in the commit.";
  }
}

TEST(GoldenHash, OfEveryPresetsFirstStepsOnEveryTarget) { expect_recorded_bits_of(scenes::first_steps_of_presets()); }

TEST(GoldenHash, OfWholeCrushesOnEveryTarget) { expect_recorded_bits_of(scenes::whole_crushes()); }

TEST(GoldenHash, SeesALastBitOfAPosition) {
  Simulation simulation(scenes::build(scenes::preset("hexagon-small")));
  simulation.advance(100);
  State state = simulation.state();
  const std::uint64_t before = scenes::hash_of(state);
  state.position[7].x() = std::nextafter(state.position[7].x(), 1e9);
  EXPECT_NE(scenes::hash_of(state), before);
}

}  // namespace
}  // namespace cellcrush
