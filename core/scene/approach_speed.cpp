#include "scene/approach_speed.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "push/half_planes.h"

namespace cellcrush {
namespace {

/// Calls visit(velocity) for every velocity that the motions of a held particle give it up to their last point. A free
/// component keeps its initial velocity.
template <class Visit>
void visit_velocities(const Scene& scene, const Support& held, const Vector2& initial, const Visit& visit) {
  const auto motion_of = [&](const Hold& hold) { return hold.motion < 0 ? nullptr : &scene.motions[hold.motion]; };
  const TimeFunction* const x = motion_of(held.x);
  const TimeFunction* const y = motion_of(held.y);
  const Vector2 resting(held.x.held ? 0.0 : initial.x(), held.y.held ? 0.0 : initial.y());
  std::set<double> times;
  for (const TimeFunction* motion : {x, y}) {
    if (motion != nullptr) {
      for (const auto& [time, value] : motion->points) times.insert(time);
    }
  }
  if (times.size() < 2 || *times.begin() > 0.0) {
    visit(resting);
  }
  if (times.size() < 2) {
    return;
  }
  for (auto from = times.begin(), to = std::next(from); to != times.end(); from = to++) {
    const auto slope = [&](const TimeFunction* motion, double otherwise) {
      return motion == nullptr ? otherwise : (motion->value_at(*to) - motion->value_at(*from)) / (*to - *from);
    };
    visit(Vector2(slope(x, resting.x()), slope(y, resting.y())));
  }
}

/// Corners of the convex hull of points, by Andrew's monotone chain. Reorders the points.
std::vector<Vector2> hull_of(std::vector<Vector2>& points) {
  const auto key = [](const Vector2& point) { return std::pair(point.x(), point.y()); };
  std::ranges::sort(points, {}, key);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Vector2> hull;
  for (const int side : {1, -1}) {
    const std::size_t first = hull.size();
    for (const Vector2& point : points) {
      while (hull.size() >= first + 2 &&
             side * cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
  }
  return hull;
}

/// Greatest distance of two points.
double diameter_of(std::vector<Vector2>& points) {
  const std::vector<Vector2> hull = hull_of(points);
  double greatest = 0.0;
  for (const Vector2& one : hull) {
    for (const Vector2& other : hull) {
      greatest = std::max(greatest, (one - other).squaredNorm());
    }
  }
  return std::sqrt(greatest);
}

/// Greatest difference of the velocities that are given, mm/s. A force on a wall acts over at most the diagonal of all
/// particles.
double speed_of_given_velocities(const Scene& scene) {
  Vector2 low = scene.position.front();
  Vector2 high = low;
  for (const Vector2& place : scene.position) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const double length = (high - low).norm();
  std::vector<Vector2> velocities;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const Vector2 initial = scene.initial_velocity.empty() ? Vector2(0.0, 0.0) : scene.initial_velocity[i];
    if (scene.supports.empty()) {
      velocities.push_back(initial);
    } else {
      visit_velocities(scene, scene.supports[i], initial,
                       [&](const Vector2& velocity) { velocities.push_back(velocity); });
    }
  }
  for (const RigidWall& wall : scene.rigid_walls) {
    velocities.emplace_back(0.0, 0.0);
    velocities.emplace_back((wall.speed + wall.speed_by_force(length)) * wall.normal);
    for (const auto& [time, speed] : wall.velocity.points) velocities.emplace_back(speed * wall.normal);
    const auto& points = wall.motion.points;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const double speed = (points[k].second - points[k - 1].second) / (points[k].first - points[k - 1].first);
      velocities.emplace_back(speed * wall.normal);
    }
  }
  return diameter_of(velocities);
}

/// Greatest speed of a particle that turns with the node of an imposed rotation, mm/s.
double speed_of_rotations(const Scene& scene) {
  const Vector2 sum = std::accumulate(scene.position.begin(), scene.position.end(), Vector2(0.0, 0.0));
  const Vector2 middle = sum / static_cast<double>(scene.particle_count());
  double radius = 0.0;
  for (const Vector2& place : scene.position) {
    radius = std::max(radius, (place - middle).norm());
  }
  double speed = 0.0;
  for (std::size_t i = 0; i < scene.supports.size(); ++i) {
    if (const int motion = scene.supports[i].rotation.motion; motion >= 0) {
      const auto& points = scene.motions[motion].points;
      const double arm = (scene.position[i] - middle).norm() + radius;
      for (std::size_t k = 1; k < points.size(); ++k) {
        const double spin = (points[k].second - points[k - 1].second) / (points[k].first - points[k - 1].first);
        speed = std::max(speed, std::abs(spin) * arm);
      }
    }
  }
  return speed;
}

double speed_of_fall(const Scene& scene) {
  double low = 0.0;
  double high = 0.0;
  for (const Vector2& place : scene.position) {
    const double drop = scene.gravity.dot(place - scene.position.front());  // g times the height
    low = std::min(low, drop);
    high = std::max(high, drop);
  }
  return std::sqrt(2.0 * (high - low));
}

/// Greatest speed along the normal of a rigid wall with which a particle that falls freely from rest comes to it where
/// it is farthest away, or with which it falls on the particle if it has a mass, mm/s.
double speed_of_fall_on_walls(const Scene& scene) {
  double square = 0.0;
  for (const RigidWall& wall : scene.rigid_walls) {
    const double towards =
        wall.mass > 0.0 ? std::abs(scene.gravity.dot(wall.normal)) : std::max(0.0, -scene.gravity.dot(wall.normal));
    const auto lowest = std::ranges::min(wall.motion.points, {}, [](const auto& point) { return point.second; });
    for (const Vector2& place : scene.position) {
      square = std::max(square, 2.0 * towards * (wall.normal.dot(place - wall.point) - lowest.second));
    }
  }
  return std::sqrt(square);
}

}  // namespace

double approach_speed_of(const Scene& scene) {
  return speed_of_given_velocities(scene) + speed_of_rotations(scene) +
         std::max(speed_of_fall(scene), speed_of_fall_on_walls(scene));
}

}  // namespace cellcrush
