#include "worker/large_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"

namespace cellcrush::worker {
namespace {

/// Large enough for large pages, in its undeformed state.
std::shared_ptr<const Scene> large_specimen() {
  SceneSpec spec = scenes::with_the_papers_elements(scenes::hexagon_specimen(10, 1000));
  spec.imperfection = {0.01, 1};
  return scenes::build(spec);
}

TEST(LargePages, AreUnderMostOfASimulation) {
  const Simulation simulation(large_specimen());
  std::vector<std::pair<std::uintptr_t, std::uintptr_t>> arrays;
  std::size_t bytes_of_all = 0;
  simulation.visit_arrays([&](const void* first, std::size_t bytes) {
    const auto begin = reinterpret_cast<std::uintptr_t>(first);
    arrays.emplace_back(begin, begin + bytes);
    bytes_of_all += bytes;
  });
  std::sort(arrays.begin(), arrays.end());
  for (std::size_t i = 1; i < arrays.size(); ++i) {
    EXPECT_LE(arrays[i - 1].second, arrays[i].first) << "array " << i << " is visited twice";
  }
  const double of_element = static_cast<double>(bytes_of_all) / static_cast<double>(simulation.scene().element_count());
  EXPECT_GT(of_element, 300.0);
  EXPECT_LT(of_element, 600.0);
}

TEST(LargePages, ChangeNoNumber) {
  Simulation simulation(large_specimen());
  simulation.advance(20);
  const auto bytes = simulation.checkpoint();
  use_large_pages(simulation);
  EXPECT_TRUE(simulation.checkpoint() == bytes);
  simulation.advance(20);
  Simulation other(large_specimen());
  other.advance(40);
  EXPECT_TRUE(simulation.checkpoint() == other.checkpoint());
}

}  // namespace
}  // namespace cellcrush::worker
