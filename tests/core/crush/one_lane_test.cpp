// This program has the kernels built with one lane (core/CMakeLists.txt, cellcrush_one_lane). Their bits are those of
// the full width: neither how walls and pairs are laid side by side, nor the order of their sums depends on it. The
// file's hashes are of the full width, by golden_hash_test.cpp.
#include <gtest/gtest.h>

#include "core/crush/golden_hashes.h"

namespace cellcrush {
namespace {

TEST(OneLane, GivesTheBitsOfTheFullWidthOverWholeCrushes) {
  if (!scenes::is_processor_of_the_file()) {
    GTEST_SKIP() << "The recorded bits are those of processors with fused multiply-add.";
  }
  scenes::Hashes recorded = scenes::read_hashes();
  for (const auto& [key, hash] : scenes::hashes_of(scenes::whole_crushes())) {
    EXPECT_EQ(recorded[key], hash) << key;
  }
}

}  // namespace
}  // namespace cellcrush
