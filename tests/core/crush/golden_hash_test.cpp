// The bits of small whole crushes on every target, and of every preset's first steps on one target of either bits.
// They change only by a commit that says why. The program core_one_lane has the kernels built with one lane
// (core/CMakeLists.txt).
// Their bits are those of the full width: neither how walls and pairs are laid side by side, nor the order of their
// sums depends on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "scenes/frames.h"
#include "scenes/presets.h"
#include "scenes/state_hash.h"
#include "scenes/whole_crushes.h"

namespace cellcrush {
namespace {

/// A crush of which the bits are recorded.
struct GoldenCrush {
  std::string name;
  SceneSpec spec;
  int steps = 0;  ///< 0 for all
};

using Hashes = std::map<std::string, std::string>;  ///< of "crush,fused" or "crush,separate"

std::vector<GoldenCrush> whole_crushes() {
  std::vector<GoldenCrush> crushes;
  for (const auto& [name, spec] : scenes::whole_crushes()) crushes.push_back({name, spec});
  return crushes;
}

Hashes read_hashes() {
  std::ifstream file(CELLCRUSH_GOLDEN_HASHES);
  Hashes hashes;
  std::string line;
  std::getline(file, line);  // the names of the columns
  while (std::getline(file, line)) {
    const std::size_t comma = line.rfind(',');
    hashes[line.substr(0, comma)] = line.substr(comma + 1);
  }
  return hashes;
}

/// The hashes on some targets. Those that give the same bits are held to each other.
Hashes hashes_of(const std::vector<GoldenCrush>& crushes, const std::vector<std::string>& targets) {
  Hashes hashes;
  for (const std::string& target : targets) {
    EXPECT_TRUE(use_simd_target(target));
    for (const GoldenCrush& crush : crushes) {
      EXPECT_EQ(simd_target(), target);  // the question must not choose the best target again
      Simulation simulation(scenes::build(crush.spec));
      simulation.advance(crush.steps > 0 ? crush.steps : simulation.scene().schedule.step_count);
      std::ostringstream hash;
      hash << std::hex << std::setw(16) << std::setfill('0') << scenes::hash_of(simulation.state());
      const auto [of_bits, is_first] = hashes.emplace(crush.name + "," + scenes::bits_of_target(target), hash.str());
      EXPECT_EQ(of_bits->second, hash.str()) << crush.name << " on " << target;
    }
  }
  EXPECT_TRUE(use_simd_target(""));
  return hashes;
}

/// Set to rewrite the file.
constexpr const char* kRewrite = "CELLCRUSH_WRITE_HASHES";

/// Holds crushes to the file, or writes theirs into it. Its bits are those of processors with fused multiply-add: the C
/// library's sine, and with it the mesh, rounds otherwise without it.
void expect_recorded_bits_of(const std::vector<GoldenCrush>& crushes, const std::vector<std::string>& targets) {
  if (std::ranges::count(simd_targets(), std::string("avx2")) == 0) {
    GTEST_SKIP() << "The recorded bits are those of processors with fused multiply-add.";
  }
  Hashes recorded = read_hashes();
  const Hashes found = hashes_of(crushes, targets);
  if (std::getenv(kRewrite) == nullptr) {
    for (const auto& [key, hash] : found) {
      EXPECT_EQ(recorded[key], hash) << key << ": the bits have changed. If they were meant to, run this test with "
                                     << kRewrite << "=1 and say why in the commit.";
    }
    return;
  }
  for (const auto& [key, hash] : found) recorded[key] = hash;
  std::ofstream file(CELLCRUSH_GOLDEN_HASHES);
  file << "crush,bits,hash\n";
  for (const auto& [key, hash] : recorded) file << key << "," << hash << "\n";
}

#ifdef CELLCRUSH_ONE_LANE
TEST(OneLane, GivesTheBitsOfTheFullWidthOverWholeCrushes) { expect_recorded_bits_of(whole_crushes(), simd_targets()); }
#else
TEST(GoldenHash, OfEveryPresetsFirstSteps) {
  std::vector<GoldenCrush> crushes;
  for (const auto& [name, spec] : scenes::presets()) crushes.push_back({name, spec, 50});
  expect_recorded_bits_of(crushes, scenes::distinct_targets());
}

TEST(GoldenHash, OfWholeCrushesOnEveryTarget) { expect_recorded_bits_of(whole_crushes(), simd_targets()); }
#endif

}  // namespace
}  // namespace cellcrush
