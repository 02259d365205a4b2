#include "contact/thickening.h"

#include <algorithm>
#include <cmath>

#include "contact/growth_forces-inl.h"
#include "contact/start_overlaps.h"

namespace cellcrush {
namespace {

/// `most`: the greatest reach of the pair.
double reach_with(const Scene& scene, int ball, int segment, double growth, double most) {
  const double before = std::min(scene.full_reach_of(ball, segment), most);
  return growth > 0.0 ? std::min(before + growth, most) : before;
}

}  // namespace

double reach_at(const Scene& scene, const State& state, int ball, int segment, double share) {
  const double most = most_reach_now(scene, state, ball, segment);
  const auto at_node = [&](int node) {
    return reach_with(scene, ball, segment, growth_of_ball(state, ball) + growth_of_ball(state, node), most);
  };
  return std::lerp(at_node(scene.elements[segment].start), at_node(scene.elements[segment].end),
                   HWY_NAMESPACE::share_of_end(share));
}

double greatest_reach(const Scene& scene, const State& state, int ball, int segment) {
  return reach_with(
      scene, ball, segment,
      growth_of_ball(state, ball) + half_thickness_now(scene, state, segment) - 0.5 * scene.elements[segment].thickness,
      scene.most_reach_of(ball, segment));
}

double growth_of_reach(const Scene& scene, const State& state, std::size_t first, std::size_t end) {
  if (state.thickening_step.empty()) {
    return 0.0;
  }
  const auto begin = state.thickening_step.begin();
  const auto most = std::max_element(begin + scene.bands[first].first_chunk, begin + scene.bands[end - 1].end_chunk);
  return 2.0 * std::max(*most, 0.0);
}

void push_elements_apart(const Scene& scene, State& state, int ball, double force) {
  HWY_NAMESPACE::push_elements_apart(scene, state, ball, force);
}

void push_by_growth(const Scene& scene, State& state, const GrownTouch& touch) {
  HWY_NAMESPACE::push_by_growth(scene, state, touch);
}

}  // namespace cellcrush
