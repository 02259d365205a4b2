// The search's loops on vectors against the same one by one, for every kernel that the processor has.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "cellcrush/simd.h"
#include "search/near_corners.h"
#include "touch/awake_candidates.h"

namespace cellcrush {
namespace {

/// Calls visit() with every kernel in use, one after the other.
template <class Visit>
void for_every_target(Visit&& visit) {
  for (const std::string& target : simd_targets()) {
    SCOPED_TRACE(target);
    ASSERT_TRUE(use_simd_target(target));
    visit();
  }
  ASSERT_TRUE(use_simd_target(""));
}

NearCorners near_corners(const std::vector<Vector2>& places, std::uint64_t corners, const FaceSegment& segment) {
  NearCorners found;
  find_near_corners(places, corners, segment, 0.25, found);
  return found;
}

TEST(WideSearch, FindsTheCornersNearASegmentToTheSameBits) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> place(-1.0, 3.0);
  for (std::size_t count = 1; count <= kManyCorners; ++count) {
    std::vector<Vector2> places;
    for (std::size_t i = 0; i < count; ++i) {
      places.emplace_back(place(generator), place(generator));
    }
    places.resize(filled_tiles(count), places.back());
    const std::uint64_t corners = generator() & ~std::uint64_t{0} >> (kManyCorners - count);
    const FaceSegment segment = {{0.1, 0.2}, Vector2(2.0, 1.0).normalized(), 1.7};
    ASSERT_TRUE(use_simd_target("scalar"));
    const NearCorners expected = near_corners(places, corners, segment);
    EXPECT_EQ(expected.near & ~corners, 0u);
    for_every_target([&] {
      const NearCorners found = near_corners(places, corners, segment);
      EXPECT_EQ(found.near, expected.near);
      EXPECT_EQ(found.least_of_others, expected.least_of_others);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(found.squared_distance[i], expected.squared_distance[i]);
      }
    });
  }
}

/// Candidates of three groups, every fifth of them or so awake.
ContactLists some_candidates(std::size_t batches, bool by_faces, std::mt19937& generator) {
  ContactLists lists;
  lists.group_travel = {1.0, 2.0, 3.0};
  for (std::size_t place = 0; place < batches * kCandidateBatch; ++place) {
    const double travel = by_faces ? lists.group_travel[place / kCandidateBatch % 3] : 0.0;
    const bool awake = generator() % 5 == 0;
    lists.candidate_next_check_travel.push_back(awake                  ? travel
                                                : generator() % 2 == 0 ? travel + 0.1
                                                                       : std::numeric_limits<double>::infinity());
  }
  for (std::size_t batch = 0; by_faces && batch < batches; ++batch) {
    lists.batch_group.push_back(static_cast<int>(batch % 3));
  }
  return lists;
}

TEST(WideSearch, FindsTheCandidatesThatAreAwake) {
  std::mt19937 generator(5);
  for (const bool by_faces : {true, false}) {
    for (const std::size_t batches : {0, 1, 3, 8, 9, 100}) {
      const ContactLists lists = some_candidates(batches, by_faces, generator);
      const std::size_t first = batches > 2 ? kCandidateBatch : 0;
      std::vector<int> awake;
      for (std::size_t place = first; place < lists.candidate_next_check_travel.size(); ++place) {
        const double travel = by_faces ? lists.group_travel[lists.batch_group[place / kCandidateBatch]] : 0.0;
        if (lists.candidate_next_check_travel[place] <= travel) {
          awake.push_back(static_cast<int>(place));
        }
      }
      for_every_target([&] {
        constexpr int kUntouched = -7;
        std::vector<int> places(awake.size() + kCandidateBatch + 1, kUntouched);
        const std::size_t count =
            find_awake_candidates(lists, first, lists.candidate_next_check_travel.size(), places.data());
        EXPECT_EQ(places.back(), kUntouched);
        places.resize(count);
        EXPECT_EQ(places, awake);
      });
    }
  }
}

}  // namespace
}  // namespace cellcrush
