#include "contact/border_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

#include "contact/bucket_grid.h"
#include "scene/bands.h"

namespace cellcrush {
namespace {

/// The border's particles. What is not finite is left out: the run is stopped by its check of the state.
struct Border {
  std::vector<Vector2> place;
  std::vector<int> band;
  std::vector<int> last_band;  ///< of the elements there; not before the particle's own
  double highest_speed = 0.0;

  /// Whether what two of them do to each other has to do with two neighbouring bands only.
  [[nodiscard]] bool are_neighbours(std::size_t a, std::size_t b) const {
    return std::max(last_band[a], last_band[b]) - std::min(band[a], band[b]) <= 1;
  }
};

/// The first element of every band.
std::vector<int> first_elements(const Scene& scene) {
  std::vector<int> first;
  for (const LatticeBand& band : scene.bands) {
    first.push_back(first_element_of(scene, band));
  }
  return first;
}

int last_band_at(const Scene& scene, const std::vector<int>& first_elements, int particle) {
  const int last = scene.incidence[scene.incidence_offset[particle + 1] - 1];  // they ascend
  const auto behind = std::upper_bound(first_elements.begin(), first_elements.end(), last);
  return static_cast<int>(behind - first_elements.begin()) - 1;
}

Border border_of(const Scene& scene, const State& state) {
  Border border;
  const std::vector<int> first = first_elements(scene);
  double squared_speed = 0.0;
  for (std::size_t b = 0; b < scene.bands.size(); ++b) {
    const FacesOfBand& faces = scene.faces.bands[b];
    for (int k = faces.offset[faces.count() - 1]; k < faces.offset[faces.count()]; ++k) {
      const int particle = faces.particle[k];
      const bool is_finite = state.position[particle].allFinite() && state.velocity[particle].allFinite();
      if (scene.bands[b].owns(particle) && is_finite) {
        border.place.push_back(state.position[particle]);
        border.band.push_back(static_cast<int>(b));
        border.last_band.push_back(last_band_at(scene, first, particle));
        squared_speed = std::max(squared_speed, state.velocity[particle].squaredNorm());
      }
    }
  }
  border.highest_speed = std::sqrt(squared_speed);
  return border;
}

/// Whether along a direction bands follow each other, so that those which are no neighbours are more than a margin apart: nearly
/// always.
bool follow_each_other(const Border& border, std::size_t bands, const Vector2& direction, double margin) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> highest(bands, -kFar);  // of the particles up to a band
  std::vector<double> lowest(bands, kFar);    // of the particles from a band on
  for (std::size_t i = 0; i < border.place.size(); ++i) {
    const double place = direction.dot(border.place[i]);
    highest[border.band[i]] = std::max(highest[border.band[i]], place);
    lowest[border.last_band[i]] = std::min(lowest[border.last_band[i]], place);
  }
  for (std::size_t b = 1; b < bands; ++b) {
    highest[b] = std::max(highest[b], highest[b - 1]);
    lowest[bands - 1 - b] = std::min(lowest[bands - 1 - b], lowest[bands - b]);
  }
  for (std::size_t b = 2; b < bands; ++b) {
    if (!(highest[b - 2] + margin < lowest[b])) {
      return false;
    }
  }
  return true;
}

/// The same of any two particles.
bool are_apart(const Border& border, double margin) {
  if (border.place.empty()) {
    return true;
  }
  const BucketGrid grid(border.place, margin);
  bool apart = true;
  for (std::size_t i = 0; i < border.place.size() && apart; ++i) {
    const Vector2 reach = Vector2::Constant(margin);
    grid.visit_box(border.place[i] - reach, border.place[i] + reach, [&](int other) {
      apart = apart && (border.are_neighbours(i, static_cast<std::size_t>(other)) ||
                        (border.place[i] - border.place[other]).norm() > margin);
    });
  }
  return apart;
}

}  // namespace

bool borders_are_apart(const Scene& scene, const State& state, std::int64_t steps) {
  const Border border = border_of(scene, state);
  const double time = scene.schedule.time_step * static_cast<double>(steps);
  const double longest = *std::max_element(scene.walls.undeformed_length.begin(), scene.walls.undeformed_length.end());
  const double margin = longest + 2.0 * scene.largest_radius + 2.0 * (2.0 * border.highest_speed) * time;
  const Vector2 directions[] = {Vector2::UnitX(), Vector2::UnitY(), -Vector2::UnitX(), -Vector2::UnitY()};
  return std::any_of(std::begin(directions), std::end(directions),
                     [&](const Vector2& direction) {
                       return follow_each_other(border, scene.bands.size(), direction, margin);
                     }) ||
         are_apart(border, margin);
}

}  // namespace cellcrush
