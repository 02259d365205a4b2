#include "measure/columns.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace cellcrush {
namespace {

/// Sums some quantities of the particles over the columns. Consecutive particles are mostly in the same column. They
/// are added to different partial sums, so that no addition waits for the one before.
template <int kQuantities>
class ColumnSums {
 public:
  using Values = Eigen::Array<double, kQuantities, 1>;

  explicit ColumnSums(const Columns& columns)
      : columns_(columns), part_(kParts * columns.place.size(), Values::Zero()) {}

  void add(std::size_t particle, const Values& values) {
    Values* sum = &part_[next_ * columns_.place.size() + columns_.lower[particle]];
    next_ = (next_ + 1) % kParts;
    sum[0] += (1.0 - columns_.share[particle]) * values;
    sum[1] += columns_.share[particle] * values;
  }

  [[nodiscard]] std::vector<double> total(int quantity) const {
    const std::size_t count = columns_.place.size();
    std::vector<double> sum(count, 0.0);
    for (std::size_t i = 0; i < part_.size(); ++i) {
      sum[i % count] += part_[i][quantity];
    }
    return sum;
  }

 private:
  static constexpr std::size_t kParts = 4;

  const Columns& columns_;
  std::vector<Values> part_;
  std::size_t next_ = 0;
};

/// Length times thickness of the walls in every column.
template <class LengthOf>
std::vector<double> sum_walls(const Columns& columns, const Scene& scene, const LengthOf& length_of) {
  using Area = ColumnSums<1>;
  Area area(columns);
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    const Element& element = scene.elements[e];
    const double half = 0.5 * element.thickness * length_of(e);
    area.add(static_cast<std::size_t>(element.start), Area::Values(half));
    area.add(static_cast<std::size_t>(element.end), Area::Values(half));
  }
  return area.total(0);
}

}  // namespace

Columns divide_into_columns(const Scene& scene, double pitch) {
  const int axis = scene.plates.axis;
  const auto [low, high] = std::minmax_element(scene.position.begin(), scene.position.end(),
                                               [&](const Vector2& a, const Vector2& b) { return a[axis] < b[axis]; });
  const double extent = (*high)[axis] - (*low)[axis];
  const int gaps = std::max(1, static_cast<int>(std::lround(extent / pitch)));
  Columns columns;
  columns.axis = axis;
  columns.begin = (*low)[axis];
  columns.place.assign(gaps + 1, 0.0);
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const double place = scene.position[i][axis] - columns.begin;
    const double gap = gaps * place / extent;
    columns.lower.push_back(std::clamp(static_cast<int>(gap), 0, gaps - 1));
    columns.share.push_back(gap - columns.lower.back());
  }
  ColumnSums<2> masses(columns);
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    masses.add(i, scene.mass[i] * Eigen::Array2d(1.0, scene.position[i][axis] - columns.begin));
  }
  columns.mass = masses.total(0);
  columns.place = masses.total(1);
  for (int k = 0; k <= gaps; ++k) {
    columns.place[k] /= columns.mass[k];
  }
  columns.wall_area = sum_walls(columns, scene, [&](std::size_t e) {
    return (scene.position[scene.elements[e].end] - scene.position[scene.elements[e].start]).norm();
  });
  return columns;
}

Profile measure_columns(const Columns& columns, const Scene& scene, const State& state) {
  ColumnSums<2> motion(columns);
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const double place = state.position[i][columns.axis] - columns.begin;
    motion.add(i, scene.mass[i] * Eigen::Array2d(place, state.velocity[i][columns.axis]));
  }
  Profile profile{motion.total(0), motion.total(1)};
  for (std::size_t k = 0; k < columns.mass.size(); ++k) {
    profile.displacement[k] = profile.displacement[k] / columns.mass[k] - columns.place[k];
    profile.velocity[k] /= columns.mass[k];
  }
  return profile;
}

std::vector<double> measure_walls(const Columns& columns, const Scene& scene, const State& state) {
  return sum_walls(columns, scene, [&](std::size_t e) {
    const double grown = state.thickening.empty() ? 0.0 : 2.0 * state.thickening[e] / scene.elements[e].thickness;
    return state.length[e] * (1.0 + grown);
  });
}

}  // namespace cellcrush
