#include "measure/columns.h"

#include <algorithm>
#include <cmath>

namespace cellcrush {
namespace {

/// Adds a particle's part of a quantity to its two columns.
void accumulate_share(const Columns& columns, std::size_t particle, double value, std::vector<double>& sum) {
  const int lower = columns.lower[particle];
  sum[lower] += (1.0 - columns.share[particle]) * value;
  sum[lower + 1] += columns.share[particle] * value;
}

/// Length times thickness of the walls of every column.
std::vector<double> measure_walls(const Columns& columns, const Scene& scene, const std::vector<Vector2>& position) {
  std::vector<double> area(columns.mass.size(), 0.0);
  for (const Element& element : scene.elements) {
    const double half = 0.5 * element.thickness * (position[element.end] - position[element.start]).norm();
    accumulate_share(columns, static_cast<std::size_t>(element.start), half, area);
    accumulate_share(columns, static_cast<std::size_t>(element.end), half, area);
  }
  return area;
}

}  // namespace

Columns divide_into_columns(const Scene& scene, double pitch) {
  const int axis = scene.plates.axis;
  const auto [low, high] = std::minmax_element(scene.position.begin(), scene.position.end(),
                                               [&](const Vector2& a, const Vector2& b) { return a[axis] < b[axis]; });
  const double begin = (*low)[axis];
  const double extent = (*high)[axis] - begin;
  const int gaps = std::max(1, static_cast<int>(std::lround(extent / pitch)));
  Columns columns;
  columns.axis = axis;
  columns.place.assign(gaps + 1, 0.0);
  columns.mass.assign(gaps + 1, 0.0);
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const double place = scene.position[i][axis] - begin;
    const double gap = gaps * place / extent;
    columns.lower.push_back(std::clamp(static_cast<int>(gap), 0, gaps - 1));
    columns.share.push_back(gap - columns.lower.back());
    accumulate_share(columns, i, scene.mass[i], columns.mass);
    accumulate_share(columns, i, scene.mass[i] * place, columns.place);
  }
  for (int k = 0; k <= gaps; ++k) {
    columns.place[k] /= columns.mass[k];
  }
  columns.wall_area = measure_walls(columns, scene, scene.position);
  return columns;
}

Profile measure_columns(const Columns& columns, const Scene& scene, const State& state) {
  const std::size_t count = columns.mass.size();
  Profile profile{std::vector<double>(count), std::vector<double>(count), {}};
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const double moved = state.position[i][columns.axis] - scene.position[i][columns.axis];
    accumulate_share(columns, i, scene.mass[i] * moved, profile.displacement);
    accumulate_share(columns, i, scene.mass[i] * state.velocity[i][columns.axis], profile.velocity);
  }
  for (std::size_t k = 0; k < count; ++k) {
    profile.displacement[k] /= columns.mass[k];
    profile.velocity[k] /= columns.mass[k];
  }
  profile.wall_area = measure_walls(columns, scene, state.position);
  return profile;
}

}  // namespace cellcrush
