#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "contact/contact_search.h"
#include "geometry/bucket_grid.h"

namespace cellcrush {
namespace {

/// Whether a contact between two particles of the border involves two adjacent bands only.
bool are_neighbours(const BorderParticle& a, const BorderParticle& b) {
  return std::max(a.last_band, b.last_band) - std::min(a.band, b.band) <= 1;
}

double highest_speed(const std::vector<BorderParticle>& border, const State& state) {
  double squared = 0.0;
  for (const BorderParticle& at : border) {
    const double of_particle = state.velocity[at.particle].squaredNorm();
    squared = std::isfinite(of_particle) ? std::max(squared, of_particle) : squared;
  }
  return std::sqrt(squared);
}

/// Whether bands follow each other along a direction, with more than a margin between bands that are not adjacent. This
/// holds nearly always.
bool follow_each_other(const Scene& scene, const State& state, const Vector2& direction, double margin) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const std::size_t bands = scene.bands.size();
  std::vector<double> highest(bands, -kFar);  // of the particles of bands up to this one
  std::vector<double> lowest(bands, kFar);    // of the particles of bands from this one on
  for (const BorderParticle& at : scene.faces.border) {
    const double place = direction.dot(state.position[at.particle]);
    highest[at.band] = std::max(highest[at.band], place);
    lowest[at.last_band] = std::min(lowest[at.last_band], place);
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

/// Whether any two particles of bands that are not adjacent are more than a margin apart.
bool are_apart(const Scene& scene, const State& state, double margin) {
  std::vector<BorderParticle> border;
  std::vector<Vector2> place;
  for (const BorderParticle& at : scene.faces.border) {
    if (state.position[at.particle].allFinite()) {
      border.push_back(at);
      place.push_back(state.position[at.particle]);
    }
  }
  if (place.empty()) {
    return true;
  }
  const BucketGrid grid(place, margin);
  const Vector2 reach = Vector2::Constant(margin);
  bool apart = true;
  for (std::size_t i = 0; i < place.size() && apart; ++i) {
    grid.visit_box(place[i] - reach, place[i] + reach, [&](int other) {
      apart = apart && (are_neighbours(border[i], border[other]) || (place[i] - place[other]).norm() > margin);
    });
  }
  return apart;
}

}  // namespace

bool borders_are_apart(const Scene& scene, const State& state, std::int64_t steps) {
  const double time = scene.schedule.time_step * static_cast<double>(steps);
  const double longest = *std::max_element(scene.walls.undeformed_length.begin(), scene.walls.undeformed_length.end());
  const double speed = highest_speed(scene.faces.border, state);
  const double margin = longest + 2.0 * scene.greatest_radius() + 2.0 * (2.0 * speed) * time;
  const Vector2 directions[] = {Vector2::UnitX(), Vector2::UnitY(), -Vector2::UnitX(), -Vector2::UnitY()};
  return std::any_of(std::begin(directions), std::end(directions),
                     [&](const Vector2& direction) { return follow_each_other(scene, state, direction, margin); }) ||
         are_apart(scene, state, margin);
}

}  // namespace cellcrush
