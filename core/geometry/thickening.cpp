#include "geometry/thickening.h"

#include <cmath>

#include "geometry/capsule-inl.h"

namespace cellcrush {
namespace {

double reach_with(const Scene& scene, int ball, int segment, double growth) {
  const double before = scene.reach_of(ball, segment);
  return growth > 0.0 ? std::min(before + growth, scene.most_reach_of(ball, segment)) : before;
}

}  // namespace

double reach_at(const Scene& scene, const State& state, int ball, int segment, double share) {
  const auto at_node = [&](int node) {
    return reach_with(scene, ball, segment, growth_of_ball(state, ball) + growth_of_ball(state, node));
  };
  return std::lerp(at_node(scene.elements[segment].start), at_node(scene.elements[segment].end),
                   HWY_NAMESPACE::share_of_end(share));
}

double greatest_reach(const Scene& scene, const State& state, int ball, int segment) {
  return reach_with(scene, ball, segment,
                    growth_of_ball(state, ball) + half_thickness_now(scene, state, segment) -
                        0.5 * scene.elements[segment].thickness);
}

double growth_of_reach(const Scene& scene, const State& state, std::size_t first, std::size_t end) {
  if (state.thickening_step.empty()) {
    return 0.0;
  }
  const auto begin = state.thickening_step.begin();
  const auto most = std::max_element(begin + scene.bands[first].first_chunk, begin + scene.bands[end - 1].end_chunk);
  return 2.0 * std::max(*most, 0.0);
}

}  // namespace cellcrush
