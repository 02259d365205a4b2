#include "jobs/mesh_places.h"

#include <gmock/gmock.h>

#include <atomic>
#include <deque>
#include <thread>
#include <vector>

#include "error.h"
#include "server/refuses.h"

namespace cellcrush::jobs {
namespace {

using Place = MeshPlaces::Place;

constexpr std::int64_t kSmall = MeshPlaces::kMostOfSmall;
constexpr std::int64_t kLarge = kSmall + 1;

bool never() { return false; }

// Whether a mesh gets a place at once: it gives up when it is asked again.
bool gets_place(MeshPlaces& places, std::int64_t elements) {
  int looks = 0;
  try {
    const Place place(places, elements, [&looks] { return ++looks > 1; });
    return true;
  } catch (const ServiceError& given_up) {
    EXPECT_EQ(given_up.kind(), ServiceError::Kind::cancelled);
    return false;
  }
}

TEST(MeshPlaces, OneLargeMeshIsBuiltAtATimeBesideSmallOnes) {
  MeshPlaces places;
  {
    const Place large(places, kLarge, never);
    EXPECT_FALSE(gets_place(places, kLarge));
    EXPECT_TRUE(gets_place(places, kSmall));
  }
  EXPECT_TRUE(gets_place(places, kLarge));
}

TEST(MeshPlaces, SmallMeshesAreBounded) {
  MeshPlaces places;
  std::deque<Place> taken;
  for (int i = 0; i < MeshPlaces::kSmallMeshes; ++i) taken.emplace_back(places, 1, never);
  EXPECT_FALSE(gets_place(places, 1));
  EXPECT_TRUE(gets_place(places, kLarge));
  EXPECT_TRUE(gets_place(places, 0)) << "nothing is built";
  taken.pop_front();
  EXPECT_TRUE(gets_place(places, 1));
}

TEST(MeshPlaces, WhoCameFirstBuildsFirstAndWhoGaveUpLeavesTheLine) {
  MeshPlaces places;
  std::vector<int> order;
  std::deque<std::atomic<bool>> waiting;
  std::deque<std::jthread> threads;
  {
    const Place first(places, kLarge, never);
    for (int i = 0; i < 5; ++i) {
      std::atomic<bool>& waits = waiting.emplace_back(false);
      threads.emplace_back([&places, &order, &waits, i] {
        const Place place(places, kLarge, [&waits] {
          waits = true;
          waits.notify_one();
          return false;
        });
        order.push_back(i);  // one at a time
      });
      waits.wait(false);
      EXPECT_FALSE(gets_place(places, kLarge));
    }
  }
  threads.clear();
  EXPECT_THAT(order, ::testing::ElementsAre(0, 1, 2, 3, 4));
}

TEST(MeshPlaces, AfterSomeSecondsOthersAreNamedAsTheCause) {
  MeshPlaces places;
  const Place large(places, kLarge, never);
  EXPECT_THAT([&] { const Place second(places, kLarge, never, std::chrono::seconds(1)); },
              testing::Refuses(ServiceError::Kind::exhausted, ""));
}

}  // namespace
}  // namespace cellcrush::jobs
