#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "scenes/every_target.h"
#include "search/face_kernels.h"

namespace cellcrush {
namespace {

TEST(VelocityBox, HoldsTheMembersTightlyHoweverManyThereAre) {
  std::mt19937 generator(17);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  State state;
  for (int i = 0; i < 100; ++i) {
    state.velocity.emplace_back(draw(generator), draw(generator));
  }
  for (std::size_t count = 1; count <= 40; ++count) {
    std::vector<int> members(count);
    std::generate(members.begin(), members.end(), [&] { return static_cast<int>(generator() % 100); });
    std::vector<double> x;
    std::vector<double> y;
    for (const int member : members) {
      x.push_back(state.velocity[member].x());
      y.push_back(state.velocity[member].y());
    }
    const auto [left, right] = std::minmax_element(x.begin(), x.end());
    const auto [bottom, top] = std::minmax_element(y.begin(), y.end());
    scenes::for_every_target([&, left = *left, right = *right, bottom = *bottom, top = *top] {
      const VelocityBox box = box_of_velocities(state, members);
      EXPECT_EQ(box.low, Vector2(left, bottom)) << count;
      EXPECT_EQ(box.high, Vector2(right, top)) << count;
    });
  }
}

}  // namespace
}  // namespace cellcrush
