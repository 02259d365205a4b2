#include "scenes/crossings.h"

#include <algorithm>
#include <numeric>

namespace cellcrush::scenes {
namespace {

/// Twice the signed area of a, b, c.
double orientation(const Vector2& a, const Vector2& b, const Vector2& c) { return cross(b - a, c - a); }

bool cross_each_other(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0.0 && orientation(c, d, a) * orientation(c, d, b) < 0.0;
}

}  // namespace

std::vector<std::pair<int, int>> find_crossings(const Scene& scene, const State& state) {
  const auto low = [&](int e) {
    return std::min(state.position[scene.elements[e].start].x(), state.position[scene.elements[e].end].x());
  };
  const auto high = [&](int e) {
    return std::max(state.position[scene.elements[e].start].x(), state.position[scene.elements[e].end].x());
  };
  std::vector<int> order(scene.element_count());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return low(a) < low(b); });
  std::vector<std::pair<int, int>> found;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Element& first = scene.elements[order[i]];
    for (std::size_t j = i + 1; j < order.size() && low(order[j]) <= high(order[i]); ++j) {
      const Element& second = scene.elements[order[j]];
      const bool joined = first.start == second.start || first.start == second.end || first.end == second.start ||
                          first.end == second.end;
      if (!joined && cross_each_other(state.position[first.start], state.position[first.end],
                                      state.position[second.start], state.position[second.end])) {
        found.emplace_back(order[i], order[j]);
      }
    }
  }
  return found;
}

}  // namespace cellcrush::scenes
