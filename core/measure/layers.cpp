#include "measure/layers.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "measure/theory.h"
#include "push/crush.h"
#include "push/push.h"

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

/// Number of values before the split into two means with the least sum of squared residuals.
int find_step(const std::vector<double>& values) {
  const auto count = static_cast<int>(values.size());
  std::vector<double> sum(values.size() + 1, 0.0);  // of the first n values
  std::partial_sum(values.begin(), values.end(), sum.begin() + 1);
  int best = 0;
  double greatest = 0.0;
  for (int before = 1; before < count; ++before) {
    const double after_sum = sum[count] - sum[before];
    const double explained = sum[before] * sum[before] / before + after_sum * after_sum / (count - before);
    if (explained > greatest) {
      greatest = explained;
      best = before;
    }
  }
  return best;
}

/// Root mean square deviation of the values from `from` to `to` from their mean.
double scatter_of(const std::vector<double>& values, int from, int to) {
  double sum = 0.0;
  double squares = 0.0;
  for (int k = from; k < to; ++k) {
    sum += values[k];
    squares += values[k] * values[k];
  }
  const double mean = sum / (to - from);
  return std::sqrt(std::max(0.0, squares / (to - from) - mean * mean));
}

/// Displacements and velocities of the columns.
struct Profile {
  std::vector<double> displacement;  ///< K, mm along the crush, mean over the mass
  std::vector<double> velocity;      ///< K, mm/s along the crush, mean over the mass
};

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

/// Length times thickness of the walls now, mm^2 (K).
std::vector<double> measure_walls(const Columns& columns, const Scene& scene, const State& state) {
  return sum_walls(columns, scene, [&](std::size_t e) {
    const double grown = state.thickening.empty() ? 0.0 : 2.0 * state.thickening[e] / scene.elements[e].thickness;
    return state.length[e] * (1.0 + grown);
  });
}

/// Mean strain of the material between two columns.
double mean_strain(const Columns& columns, const Profile& profile, int from, int to) {
  return (profile.displacement[from] - profile.displacement[to]) / (columns.place[to] - columns.place[from]);
}

/// Mass average of a velocity over the columns from `from` to `to`.
double mean_velocity(const Columns& columns, const Profile& profile, int from, int to) {
  double momentum = 0.0;
  double mass = 0.0;
  for (int k = from; k <= to; ++k) {
    momentum += columns.mass[k] * profile.velocity[k];
    mass += columns.mass[k];
  }
  return momentum / mass;
}

constexpr double kCells = 3.0;
constexpr double kThicknesses = 4.0;

struct Layer {
  double metal = 0.0;                                    ///< mm^2, length times thickness
  double moment = 0.0;                                   ///< mm^3, of the metal about the impact end before loading
  double low = std::numeric_limits<double>::infinity();  ///< extent across the crush, mm
  double high = -std::numeric_limits<double>::infinity();
};

/// Extent across the crush of a layer and of `reach` layers on either side of it.
double width_of(const std::vector<Layer>& layers, std::size_t at, std::size_t reach) {
  const std::size_t end = std::min(at + reach + 1, layers.size());
  double low = layers[at].low;
  double high = layers[at].high;
  for (std::size_t k = at - std::min(at, reach); k < end; ++k) {
    low = std::min(low, layers[k].low);
    high = std::max(high, layers[k].high);
  }
  return high - low;
}

}  // namespace

Columns divide_into_columns(const Scene& scene, double pitch) {
  const int axis = crush_axis_of(scene);
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

std::optional<Front> find_front(const Columns& columns, const Scene& scene, const State& state) {
  const Profile profile = measure_columns(columns, scene, state);
  const double plate_speed = plate_speed_at(scene, state, state.time);
  const auto last = static_cast<int>(columns.place.size()) - 1;
  std::vector<double> strains;
  for (int k = 0; k < last; ++k) {
    strains.push_back(mean_strain(columns, profile, k, k + 1));
  }
  const int step = find_step(strains);
  const int behind = step - kColumnsOfFront;  // last column behind the front
  const int ahead = step + kColumnsOfFront;   // first column ahead of it
  const int middle = (ahead + last) / 2;      // middle of the columns ahead
  if (behind < kColumnsBeside || middle - ahead < kColumnsBeside) {
    return std::nullopt;
  }
  Front front;
  front.strain_behind = mean_strain(columns, profile, 0, behind);
  front.strain_ahead = mean_strain(columns, profile, ahead, middle);
  front.velocity_behind = mean_velocity(columns, profile, 0, behind);
  front.velocity_ahead = mean_velocity(columns, profile, ahead, last);
  const double jump = front.strain_behind - front.strain_ahead;
  const double scatter = std::max(scatter_of(strains, 0, behind), scatter_of(strains, ahead, middle));
  if (jump < kLeastJump || front.strain_behind >= 1.0 || scatter > kMostScatter * jump ||
      front.velocity_behind - front.velocity_ahead < kLeastVelocityJump * plate_speed) {
    return std::nullopt;
  }
  const double length = columns.place[middle] - columns.place[0];
  const double shortening = profile.displacement[0] - profile.displacement[middle];
  front.position = columns.place[0] + (shortening - front.strain_ahead * length) / jump;
  front.solid_fraction_behind = relative_density_of(scene) / (1.0 - front.strain_behind);
  const auto walls_behind = [&](const std::vector<double>& area) {
    return std::accumulate(area.begin(), area.begin() + behind + 1, 0.0);
  };
  front.wall_fraction_behind = front.solid_fraction_behind * walls_behind(measure_walls(columns, scene, state)) /
                               walls_behind(columns.wall_area);
  return front;
}

LayerSize size_of_layers(const Scene& scene, double pitch) {
  double thickest = 0.0;
  for (const Element& element : scene.elements) {
    thickest = std::max(thickest, element.thickness);
  }
  return {std::max(kCells * pitch * relative_density_of(scene), kThicknesses * thickest), 0.5 * pitch};
}

DensestLayer find_densest_layer(const Scene& scene, const State& state, const LayerSize& size) {
  const int axis = crush_axis_of(scene);
  const auto before = [axis](const Vector2& a, const Vector2& b) { return a[axis] < b[axis]; };
  const auto [first, last] = std::minmax_element(state.position.begin(), state.position.end(), before);
  const double begin = (*first)[axis];
  const double extent = (*last)[axis] - begin;
  const double origin = (*std::min_element(scene.position.begin(), scene.position.end(), before))[axis];
  const double most = static_cast<double>(scene.particle_count());
  std::vector<Layer> layers(static_cast<std::size_t>(std::clamp(extent / size.depth, 1.0, most)));
  const double per_depth = static_cast<double>(layers.size()) / extent;
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    const Element& element = scene.elements[e];
    const double half = 0.5 * element.thickness + (state.thickening.empty() ? 0.0 : state.thickening[e]);
    const double metal = state.length[e] * half;
    for (const int particle : {element.start, element.end}) {
      const Vector2& position = state.position[particle];
      const auto at = static_cast<std::size_t>(per_depth * (position[axis] - begin));
      Layer& layer = layers[std::min(at, layers.size() - 1)];
      layer.metal += metal;
      layer.moment += metal * (scene.position[particle][axis] - origin);
      layer.low = std::min(layer.low, position[1 - axis] - half);
      layer.high = std::max(layer.high, position[1 - axis] + half);
    }
  }
  const auto reach = static_cast<std::size_t>(std::max(1.0, size.reach * per_depth));
  DensestLayer densest;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const double fraction =
        layers[k].metal * per_depth / (state.sides.empty() ? width_of(layers, k, reach) : state.sides.front().width);
    if (layers[k].metal > 0.0 && fraction > densest.solid_fraction) {
      densest = {fraction, layers[k].moment / layers[k].metal};
    }
  }
  return densest;
}

}  // namespace cellcrush
