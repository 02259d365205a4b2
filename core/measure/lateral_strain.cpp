#include "measure/lateral_strain.h"

#include <algorithm>
#include <cmath>

#include "push/crush.h"

namespace cellcrush {
namespace {

Vector2 across_the_crush(const Scene& scene) { return normal_of(crush_direction_of(scene)); }

}  // namespace

SidePairs find_side_pairs(const Scene& scene, double pitch) {
  const Vector2 axis = crush_direction_of(scene);
  const Vector2 side = across_the_crush(scene);
  const auto along = [&](const Vector2& place) { return axis.dot(place); };
  const auto across = [&](int particle) { return side.dot(scene.position[particle]); };
  const auto [first, last] = std::ranges::minmax_element(scene.position, {}, along);
  const double begin = std::lerp(along(*first), along(*last), 0.25);
  const double half = 0.5 * (along(*last) - along(*first));
  const int rows = std::max(1, static_cast<int>(std::lround(std::min(half / pitch, 1e6))));
  constexpr int kNone = -1;
  SidePairs of_row = {std::vector(rows, kNone), std::vector(rows, kNone)};
  for (int particle = 0; particle < static_cast<int>(scene.particle_count()); ++particle) {
    const double row = std::floor((along(scene.position[particle]) - begin) / half * rows);
    if (row < 0.0 || row >= rows) continue;
    int& low = of_row.low[static_cast<int>(row)];
    int& high = of_row.high[static_cast<int>(row)];
    if (low == kNone || across(particle) < across(low)) low = particle;
    if (high == kNone || across(particle) > across(high)) high = particle;
  }
  SidePairs pairs;
  for (int row = 0; row < rows; ++row) {
    if (of_row.low[row] != kNone && across(of_row.high[row]) > across(of_row.low[row])) {
      pairs.low.push_back(of_row.low[row]);
      pairs.high.push_back(of_row.high[row]);
    }
  }
  return pairs;
}

double lateral_strain_of(const SidePairs& pairs, const Scene& scene, const State& state) {
  const Vector2 side = across_the_crush(scene);
  double sum = 0.0;
  for (std::size_t k = 0; k < pairs.low.size(); ++k) {
    const double before = side.dot(scene.position[pairs.high[k]]) - side.dot(scene.position[pairs.low[k]]);
    const double now = side.dot(state.position[pairs.high[k]]) - side.dot(state.position[pairs.low[k]]);
    sum += now / before - 1.0;
  }
  return pairs.low.empty() ? 0.0 : sum / static_cast<double>(pairs.low.size());
}

}  // namespace cellcrush
