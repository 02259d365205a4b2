#include "worker/large_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bench/machine.h"
#include "cellcrush/simulation.h"
#include "programs/temporary_folder.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"
#include "worker/checkpoint_file.h"

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
  const auto bytes = scenes::checkpoint_of(simulation);
  use_large_pages(simulation);
  EXPECT_TRUE(scenes::checkpoint_of(simulation) == bytes);
  simulation.advance(20);
  Simulation other(large_specimen());
  other.advance(40);
  EXPECT_TRUE(scenes::checkpoint_of(simulation) == scenes::checkpoint_of(other));
}

/// How far writing a checkpoint and resuming from it raise the memory above that of the run, as a share of it; none
/// if the run does not resume.
std::optional<double> measure_checkpoint(const store::JobFolder& folder) {
  Simulation simulation(large_specimen());
  simulation.advance(20);
  const double run = bench::resident_bytes();
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak is now what is resident
  write_checkpoint(folder, {}, [&](const ByteSink& sink) { simulation.checkpoint(sink); });
  const auto found = find_checkpoint(folder, {});
  if (!found.checkpoint || !simulation.restore(found.simulation)) return std::nullopt;
  return bench::greatest_resident_bytes() / run - 1.0;
}

TEST(Checkpoint, IsWrittenAndReadInLessThanATenthOfTheRunsMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "Sanitizers take memory of their own.";
#endif
  const testing::TemporaryFolder folder;
  const store::JobFolder job(folder.path());
  const auto share = bench::measure_apart([&] { return measure_checkpoint(job); });
  ASSERT_TRUE(share && *share);
  EXPECT_LT(**share, 0.1);
  EXPECT_GT(std::filesystem::file_size(job.checkpoint()), 10'000'000U);
}

}  // namespace
}  // namespace cellcrush::worker
