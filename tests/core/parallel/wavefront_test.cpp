#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "parallel/workers.h"

namespace cellcrush {
namespace {

constexpr std::size_t kSteps = 23;
constexpr std::size_t kItems = 17;
constexpr std::size_t kLag = 3;
constexpr std::size_t kAtOnce = 5;

/// Which items of which steps have been done; not guarded but by the order in which they are.
struct Done {
  bool done[kSteps][kItems] = {};

  [[nodiscard]] bool has(std::size_t step, std::size_t items) const {
    return std::all_of(done[step], done[step] + std::min(items, kItems), [](bool item) { return item; });
  }
};

TEST(Wavefront, TakesEveryItemOfEveryStepOnceAndAfterWhatItNeeds) {
  for (const int threads : {1, 2, 4}) {
    Wavefront wavefront(kSteps, kItems, kLag, kAtOnce);
    Done done;
    std::atomic<int> visits{0};
    std::atomic<int> too_early{0};
    const auto visit = [&](std::size_t step, std::size_t index) {
      const bool after_its_own = done.has(step, index) && !done.done[step][index];
      const bool after_the_step_before = step == 0 || done.has(step - 1, index + kLag);
      const bool has_room = step < kAtOnce || done.has(step - kAtOnce, kItems);
      too_early += after_its_own && after_the_step_before && has_room ? 0 : 1;
      done.done[step][index] = true;
      ++visits;
    };
    std::vector<std::thread> others;
    for (int i = 1; i < threads; ++i) {
      others.emplace_back([&] { wavefront.advance(visit); });
    }
    wavefront.advance(visit);
    for (std::thread& other : others) {
      other.join();
    }
    EXPECT_EQ(visits, static_cast<int>(kSteps * kItems)) << threads;
    EXPECT_EQ(too_early, 0) << threads;
  }
}

}  // namespace
}  // namespace cellcrush
