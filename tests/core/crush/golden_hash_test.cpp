// The bits of every preset's first steps on every target. They change only by a commit that says why.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>

#include "cellcrush/presets.h"
#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

constexpr int kSteps = 500;

/// Set to rewrite the file.
constexpr const char* kRewrite = "CELLCRUSH_WRITE_HASHES";

using Hashes = std::map<std::string, std::string>;  // of "preset,target"

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

void write_hashes(const Hashes& hashes) {
  std::ofstream file(CELLCRUSH_GOLDEN_HASHES);
  file << "preset,target,hash\n";
  for (const auto& [key, hash] : hashes) {
    file << key << "," << hash << "\n";
  }
}

std::string hash_of_first_steps(const Preset& preset) {
  Simulation simulation(scenes::build(preset.spec));
  simulation.advance(kSteps);
  std::ostringstream hash;
  hash << std::hex << std::setw(16) << std::setfill('0') << scenes::hash_of(simulation.state());
  return hash.str();
}

/// The C library's sine rounds otherwise on a processor without fused multiply-add, and the mesh with it.
bool is_processor_of_the_file() {
  const std::vector<std::string> targets = simd_targets();
  return std::find(targets.begin(), targets.end(), "avx2") != targets.end();
}

TEST(GoldenHash, OfEveryPresetsFirstStepsOnEveryTarget) {
  if (!is_processor_of_the_file()) {
    GTEST_SKIP() << "The recorded bits are those of processors with fused multiply-add.";
  }
  const Hashes recorded = read_hashes();
  Hashes found = recorded;
  for (const std::string& target : simd_targets()) {
    ASSERT_TRUE(use_simd_target(target));
    for (const Preset& preset : presets()) {
      found[preset.name + "," + target] = hash_of_first_steps(preset);
    }
  }
  ASSERT_TRUE(use_simd_target(""));
  if (std::getenv(kRewrite) != nullptr) {
    write_hashes(found);
    return;
  }
  for (const auto& [key, hash] : found) {
    const auto before = recorded.find(key);
    EXPECT_TRUE(before != recorded.end() && before->second == hash)
        << key << ": the bits have changed. If they were meant to, run this test with " << kRewrite
        << "=1 and say why in the commit.";
  }
}

TEST(GoldenHash, SeesALastBitOfAPosition) {
  Simulation simulation(scenes::build(find_preset("hexagon-small")->spec));
  simulation.advance(100);
  State state = simulation.state();
  const std::uint64_t before = scenes::hash_of(state);
  state.position[7].x() = std::nextafter(state.position[7].x(), 1e9);
  EXPECT_NE(scenes::hash_of(state), before);
}

}  // namespace
}  // namespace cellcrush
