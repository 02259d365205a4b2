#include <gtest/gtest.h>

#include <set>

#include "cellcrush/state.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

State crush(int chunk) {
  const auto scene = scenes::build(scenes::hexagon_specimen(8, 5));
  Simulation simulation(scene);
  for (int done = 0; done < 1500; done += chunk) {
    simulation.advance(chunk);
    simulation.take_sample();
    simulation.take_frame(0);
  }
  return simulation.state();
}

TEST(Determinism, SamplingAndChunksDoNotChangeABit) {
  EXPECT_EQ(scenes::hash_of(crush(1500)), scenes::hash_of(crush(150)));
}

TEST(Determinism, HashSeesTheLastBitOfEveryField) {
  State state = crush(1500);
  const std::uint64_t before = scenes::hash_of(state);
  int index = -1;
  std::set<int> unseen;
  visit_fields(state, [&](auto& field) {
    ++index;
    auto* bytes = [&] {
      if constexpr (requires { field.begin(); }) {
        return reinterpret_cast<unsigned char*>(field.data());
      } else {
        return reinterpret_cast<unsigned char*>(&field);
      }
    }();
    if (bytes == nullptr) {
      return;  // an empty list has no bits
    }
    bytes[0] ^= 1U;
    if (scenes::hash_of(state) == before) {
      unseen.insert(index);
    }
    bytes[0] ^= 1U;
  });
  EXPECT_TRUE(unseen.empty()) << *unseen.begin();
}

}  // namespace
}  // namespace cellcrush
