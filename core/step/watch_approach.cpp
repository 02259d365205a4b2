#include "step/watch_approach.h"

#include <algorithm>

namespace cellcrush {

void watch_approach(const Scene& scene, State& state) {
  if (state.fastest_step.empty()) {
    return;
  }
  Vector2 low = state.velocity[0];
  Vector2 high = low;
  for (const Vector2& velocity : state.velocity) {
    low = low.cwiseMin(velocity);
    high = high.cwiseMax(velocity);
  }
  const double travel = scene.schedule.time_step * (high - low).norm();
  FastestStep& fastest = state.fastest_step.front();
  if (travel > fastest.travel) {
    const Vector2 middle = 0.5 * (low + high);
    const auto slower = [&](const Vector2& a, const Vector2& b) {
      return (a - middle).squaredNorm() < (b - middle).squaredNorm();
    };
    const auto particle = std::max_element(state.velocity.begin(), state.velocity.end(), slower);
    fastest = {travel, state.step, particle - state.velocity.begin()};
  }
}

}  // namespace cellcrush
