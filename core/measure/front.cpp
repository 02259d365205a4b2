#include "measure/front.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "measure/theory.h"

namespace cellcrush {
namespace {

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

}  // namespace

std::optional<Front> find_front(const Columns& columns, const Scene& scene, const State& state) {
  const Profile profile = measure_columns(columns, scene, state);
  const double plate_speed = scene.plates.speed_at(state.time);
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

}  // namespace cellcrush
