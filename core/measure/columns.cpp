#include "measure/columns.h"

#include <algorithm>
#include <cmath>

namespace cellcrush {
namespace {

/// Sums a quantity of the particles over the columns. Those that follow each other are mostly of the same column: they add to
/// different parts of its sum, so that none waits for the one before it.
class ColumnSums {
 public:
  explicit ColumnSums(const Columns& columns) : columns_(columns), part_(kParts * columns.place.size(), 0.0) {}

  void add(std::size_t particle, double value) {
    double* sum = &part_[next_ * columns_.place.size() + columns_.lower[particle]];
    next_ = (next_ + 1) % kParts;
    sum[0] += (1.0 - columns_.share[particle]) * value;
    sum[1] += columns_.share[particle] * value;
  }

  [[nodiscard]] std::vector<double> total() const {
    const std::size_t count = columns_.place.size();
    std::vector<double> sum(count, 0.0);
    for (std::size_t i = 0; i < part_.size(); ++i) {
      sum[i % count] += part_[i];
    }
    return sum;
  }

 private:
  static constexpr std::size_t kParts = 4;

  const Columns& columns_;
  std::vector<double> part_;
  std::size_t next_ = 0;
};

/// Length times thickness of the walls of every column.
template <class LengthOf>
std::vector<double> measure_walls(const Columns& columns, const Scene& scene, const LengthOf& length_of) {
  ColumnSums area(columns);
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    const Element& element = scene.elements[e];
    const double half = 0.5 * element.thickness * length_of(e);
    area.add(static_cast<std::size_t>(element.start), half);
    area.add(static_cast<std::size_t>(element.end), half);
  }
  return area.total();
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
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const double place = scene.position[i][axis] - begin;
    const double gap = gaps * place / extent;
    columns.lower.push_back(std::clamp(static_cast<int>(gap), 0, gaps - 1));
    columns.share.push_back(gap - columns.lower.back());
  }
  ColumnSums mass(columns);
  ColumnSums moment(columns);
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    mass.add(i, scene.mass[i]);
    moment.add(i, scene.mass[i] * (scene.position[i][axis] - begin));
  }
  columns.mass = mass.total();
  columns.place = moment.total();
  for (int k = 0; k <= gaps; ++k) {
    columns.place[k] /= columns.mass[k];
  }
  columns.wall_area = measure_walls(columns, scene, [&](std::size_t e) {
    return (scene.position[scene.elements[e].end] - scene.position[scene.elements[e].start]).norm();
  });
  return columns;
}

Profile measure_columns(const Columns& columns, const Scene& scene, const State& state) {
  ColumnSums displacement(columns);
  ColumnSums velocity(columns);
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const double moved = state.position[i][columns.axis] - scene.position[i][columns.axis];
    displacement.add(i, scene.mass[i] * moved);
    velocity.add(i, scene.mass[i] * state.velocity[i][columns.axis]);
  }
  Profile profile{displacement.total(), velocity.total(), {}};
  for (std::size_t k = 0; k < columns.mass.size(); ++k) {
    profile.displacement[k] /= columns.mass[k];
    profile.velocity[k] /= columns.mass[k];
  }
  profile.wall_area = measure_walls(columns, scene, [&](std::size_t e) { return state.length[e]; });
  return profile;
}

}  // namespace cellcrush
