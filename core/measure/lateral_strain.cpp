#include "measure/lateral_strain.h"

#include <algorithm>
#include <cmath>

namespace cellcrush {

SidePairs find_side_pairs(const Scene& scene, double pitch) {
  const int axis = scene.plates.axis;
  const auto across = [&](int particle) { return scene.position[particle][1 - axis]; };
  const auto [first, last] =
      std::ranges::minmax_element(scene.position, {}, [axis](const Vector2& p) { return p[axis]; });
  const double begin = std::lerp((*first)[axis], (*last)[axis], 0.25);
  const double half = 0.5 * ((*last)[axis] - (*first)[axis]);
  const int rows = std::max(1, static_cast<int>(std::lround(std::min(half / pitch, 1e6))));
  constexpr int kNone = -1;
  SidePairs of_row = {std::vector(rows, kNone), std::vector(rows, kNone)};
  for (int particle = 0; particle < static_cast<int>(scene.particle_count()); ++particle) {
    const double row = std::floor((scene.position[particle][axis] - begin) / half * rows);
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
  const int axis = 1 - scene.plates.axis;
  double sum = 0.0;
  for (std::size_t k = 0; k < pairs.low.size(); ++k) {
    const double before = scene.position[pairs.high[k]][axis] - scene.position[pairs.low[k]][axis];
    const double now = state.position[pairs.high[k]][axis] - state.position[pairs.low[k]][axis];
    sum += now / before - 1.0;
  }
  return pairs.low.empty() ? 0.0 : sum / static_cast<double>(pairs.low.size());
}

}  // namespace cellcrush
