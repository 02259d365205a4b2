#include "contact/topology/wall_paths.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

namespace cellcrush {

WallPaths::WallPaths(const Scene& scene) : scene_(scene) {
  if (scene.pins.count() > 0) pin_of_.assign(scene.particle_count(), -1);
  for (std::size_t pin = 0; pin < scene.pins.count(); ++pin) {
    for (const int joint : scene.pins.joints_of(pin)) pin_of_[joint] = static_cast<int>(pin);
  }
}

double WallPaths::reach_of(int ball, int segment) {
  const double full = scene_.full_reach_of(ball, segment);
  return std::min(full, limit_of(ball, segment, full));
}

double WallPaths::limit_of(int ball, int segment, double most) {
  const Element& element = scene_.elements[segment];
  const double limit = most / kTouchingShare;
  if (ball != ball_ || limit > limit_) {
    walk_from(ball, limit);
  }
  return kTouchingShare * std::min(way_[element.start], way_[element.end]);
}

std::vector<int> WallPaths::segments_near(int ball, double largest) {
  walk_from(ball, largest / kTouchingShare);
  std::vector<int> segments;
  for (const int particle : reached_) {
    for (int k = scene_.incidence_offset[particle]; k < scene_.incidence_offset[particle + 1]; ++k) {
      const Element& element = scene_.elements[scene_.incidence[k]];
      if (element.start != ball && element.end != ball) {
        segments.push_back(scene_.incidence[k]);
      }
    }
  }
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  return segments;
}

// Dijkstra's algorithm. In most lattices it ends at the ball, because the next particle is beyond the limit.
void WallPaths::walk_from(int ball, double limit) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  way_.resize(scene_.particle_count(), kFar);
  for (const int particle : reached_) {
    way_[particle] = kFar;
  }
  ball_ = ball;
  limit_ = limit;
  reached_ = {ball};
  way_[ball] = 0.0;
  using Stop = std::pair<double, int>;
  std::priority_queue<Stop, std::vector<Stop>, std::greater<>> next;
  next.push({0.0, ball});
  const auto go_on_to = [&](int particle, double way) {
    if (way < limit && way < way_[particle]) {
      if (way_[particle] == kFar) {
        reached_.push_back(particle);
      }
      way_[particle] = way;
      next.push({way, particle});
    }
  };
  while (!next.empty()) {
    const auto [way, particle] = next.top();
    next.pop();
    if (!pin_of_.empty() && pin_of_[particle] >= 0) {
      for (const int joint : scene_.pins.joints_of(static_cast<std::size_t>(pin_of_[particle]))) go_on_to(joint, way);
    }
    for (int k = scene_.incidence_offset[particle]; k < scene_.incidence_offset[particle + 1]; ++k) {
      const Element& element = scene_.elements[scene_.incidence[k]];
      const int other = element.start == particle ? element.end : element.start;
      go_on_to(other, way + (scene_.position[element.end] - scene_.position[element.start]).norm());
    }
  }
}

LimitedReaches find_limited_reaches(const Scene& scene) {
  const double growth = scene.thickens() ? kMostThickening : 1.0;
  const double thickest = std::ranges::max(scene.elements, {}, &Element::thickness).thickness;
  LimitedReaches limited;
  limited.offset.push_back(0);
  WallPaths paths(scene);
  for (int ball = 0; ball < static_cast<int>(scene.particle_count()); ++ball) {
    for (const int segment : paths.segments_near(ball, growth * thickest)) {
      const double most = growth * scene.full_reach_of(ball, segment);
      const double reach = paths.limit_of(ball, segment, most);
      if (reach < most) {
        limited.segment.push_back(segment);
        limited.reach.push_back(reach);
      }
    }
    limited.offset.push_back(static_cast<int>(limited.segment.size()));
  }
  return limited;
}

}  // namespace cellcrush
