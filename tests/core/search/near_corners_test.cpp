#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "scenes/every_target.h"
#include "search/face_kernels.h"

namespace cellcrush {
namespace {

constexpr double kSquaredRange = 0.25;
constexpr double kNoOthers = std::numeric_limits<double>::max();
const FaceSegment kSegment = {{0.1, 0.2}, Vector2(2.0, 1.0).normalized(), 1.7};

NearCorners near_corners(const std::vector<Vector2>& places, std::size_t count) {
  NearCorners found;
  find_near_corners(places, count, kSegment, kSquaredRange, found);
  return found;
}

/// Places by their coordinates along and across the segment, and the squared distances that follow from them.
struct Corners {
  std::vector<Vector2> place;
  std::vector<double> squared_distance;

  Corners(std::size_t count, std::mt19937& generator) {
    std::uniform_real_distribution<double> draw(-1.0, 3.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double ahead = draw(generator);
      const double across = draw(generator) - 1.0;
      place.push_back(kSegment.start + ahead * kSegment.axis + across * normal_of(kSegment.axis));
      const double beyond = std::max({0.0, -ahead, ahead - kSegment.length});
      squared_distance.push_back(beyond * beyond + across * across);
    }
    place.resize(filled_tiles(count), place.back());
  }
};

TEST(NearCorners, FindsDistancesAndWhatIsWithinRange) {
  std::mt19937 generator(11);
  for (std::size_t count = 1; count <= kManyCorners; ++count) {
    const Corners drawn(count, generator);
    std::uint64_t near = 0;
    double least = kNoOthers;
    for (std::size_t i = 0; i < count; ++i) {
      if (drawn.squared_distance[i] < kSquaredRange) {
        near |= std::uint64_t{1} << i;
      } else {
        least = std::min(least, drawn.squared_distance[i]);
      }
    }
    scenes::for_every_target([&] {
      const NearCorners found = near_corners(drawn.place, count);
      EXPECT_EQ(found.near, near);
      EXPECT_NEAR(found.least_of_others, least, least == kNoOthers ? 0.0 : 1e-13);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_NEAR(found.squared_distance[i], drawn.squared_distance[i], 1e-13);
      }
    });
  }
}

// The lists of a face must not depend on the processor.
TEST(NearCorners, HaveTheSameBitsOnEveryTarget) {
  std::mt19937 generator(13);
  const Corners drawn(kManyCorners, generator);
  const NearCorners expected = near_corners(drawn.place, kManyCorners);
  scenes::for_every_target([&] {
    const NearCorners found = near_corners(drawn.place, kManyCorners);
    EXPECT_EQ(found.near, expected.near);
    EXPECT_EQ(found.least_of_others, expected.least_of_others);
    EXPECT_EQ(found.squared_distance, expected.squared_distance);
  });
}

}  // namespace
}  // namespace cellcrush
