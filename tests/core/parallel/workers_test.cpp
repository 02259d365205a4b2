#include "parallel/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <numeric>
#include <thread>
#include <vector>

namespace cellcrush {
namespace {

TEST(Workers, WakeAfterARest) {
  Workers workers(2);
  for (int round = 0; round < 3; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::vector<int> visits(2, 0);
    workers.parallel_for(2, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) {
        visits[i] = 1;
      }
    });
    EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), 0), 2);
  }
}

TEST(Workers, DoEveryPieceOnceBesideWhatTheCallerShares) {
  for (const int count : {1, 2, 3, 7}) {
    Workers workers(count);
    for (int round = 0; round < 300; ++round) {
      const auto pieces = static_cast<std::size_t>(round % 37);
      std::vector<int> visits(pieces, 0);
      std::vector<int> items(50, 0);
      workers.parallel_overlap(
          pieces, [&](std::size_t piece) { ++visits[piece]; },
          [&] {
            for (int loop = 1; loop < 4; ++loop) {
              workers.parallel_for(items.size(), [&](std::size_t first, std::size_t end) {
                for (std::size_t i = first; i < end; ++i) {
                  items[i] += items[i] == loop - 1 ? 1 : 100;
                }
              });
            }
          });
      ASSERT_EQ(visits, std::vector<int>(pieces, 1)) << count << " threads, round " << round;
      ASSERT_EQ(items, std::vector<int>(items.size(), 3)) << count << " threads, round " << round;
    }
  }
}

TEST(Workers, OtherThreadsBeginPiecesWhileTheCallerIsBusy) {
  Workers workers(2);
  std::atomic<int> done{0};
  int seen = 0;
  workers.parallel_overlap(
      5, [&](std::size_t) { ++done; },
      [&] {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (done < 5 && std::chrono::steady_clock::now() < end) {
          std::this_thread::yield();
        }
        seen = done;
      });
  EXPECT_EQ(seen, 5);
}

TEST(Workers, FinishThePiecesWhereTheCallerThrows) {
  Workers workers(3);
  std::vector<int> visits(20, 0);
  EXPECT_THROW(workers.parallel_overlap(
                   visits.size(), [&](std::size_t piece) { ++visits[piece]; }, [] { throw std::bad_alloc(); }),
               std::bad_alloc);
  EXPECT_EQ(visits, std::vector<int>(visits.size(), 1));
}

}  // namespace
}  // namespace cellcrush
