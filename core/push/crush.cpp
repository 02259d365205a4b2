#include "push/crush.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/grips.h"
#include "push/half_planes.h"

namespace cellcrush {
namespace {

/// Along the crush, of all grips that are fixed to a plate.
double impulse_of_fixed(const Scene& scene, const State& state, Grip::FixedTo plate) {
  double sum = 0.0;
  for (const Grip& grip : scene.grips) {
    if (grip.fixed_to == plate) sum += impulse_of(scene, state, grip)[scene.plates.axis];
  }
  return sum;
}

/// Of particles along an axis, with `share` of their radii, mm.
template <class Positions>
double extent_along(const Scene& scene, const Positions& position, const Vector2& axis, double share) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < position.size(); ++i) {
    low = std::min(low, axis.dot(position[i]) - share * scene.radius[i]);
    high = std::max(high, axis.dot(position[i]) + share * scene.radius[i]);
  }
  return high - low;
}

/// Distance of the faces of the walls, or length of the lattice at one wall, mm.
double distance_of(const Scene& scene, const State& state) {
  const RigidWall& impact = scene.rigid_walls[scene.crushing_walls->impact];
  if (!has_support(scene)) return extent_along(scene, state.position, impact.normal, 0.0);
  const RigidWall& support = scene.rigid_walls[scene.crushing_walls->support];
  return impact.normal.dot(support.point - impact.point) - state.rigid_wall_motion[scene.crushing_walls->impact].travel;
}

double greatest_of(const TimeFunction& function) {
  double greatest = 0.0;
  for (const auto& [time, value] : function.points) greatest = std::max(greatest, std::abs(value));
  return greatest;
}

/// The one that stands at an edge with no other wall.
std::optional<CrushingWalls> find_only_wall(const Scene& scene) {
  const auto others = scene.rigid_walls.size() - side_walls_of(scene).size();
  if (others != 1 || !scene.rigid_walls.front().at_edge) return std::nullopt;
  return CrushingWalls{0, CrushingWalls::kNone};
}

double greatest_slope_of(const TimeFunction& function) {
  double greatest = 0.0;
  for (std::size_t i = 1; i < function.points.size(); ++i) {
    const auto& [time, value] = function.points[i];
    const auto& [before, start] = function.points[i - 1];
    greatest = std::max(greatest, std::abs(value - start) / (time - before));
  }
  return greatest;
}

}  // namespace

std::optional<CrushingWalls> find_crushing_walls(const Scene& scene) {
  std::optional<CrushingWalls> found = find_only_wall(scene);
  for (std::size_t i = 0; i < scene.rigid_walls.size(); ++i) {
    const RigidWall& impact = scene.rigid_walls[i];
    if (!impact.moves()) continue;
    for (std::size_t j = 0; j < scene.rigid_walls.size(); ++j) {
      const RigidWall& support = scene.rigid_walls[j];
      const bool is_behind = impact.normal.dot(support.point - impact.point) <= 0.0;
      if (support.moves() || is_behind || !impact.is_opposite_to(support)) continue;
      if (found) return std::nullopt;
      found = {static_cast<int>(i), static_cast<int>(j)};
    }
  }
  return found;
}

bool has_crushing_walls(const std::vector<LoadsSpec::RigidWall>& walls) {
  LoadsSpec loads;
  loads.rigid_walls = walls;
  Scene scene;
  attach_half_planes(loads, Vector2::Zero(), scene);
  return find_crushing_walls(scene).has_value();
}

void put_crushing_walls(Scene& scene) {
  std::optional<CrushingWalls> walls = find_crushing_walls(scene);
  if (!walls) return;
  const RigidWall& impact = scene.rigid_walls[walls->impact];
  const double length = extent_along(scene, scene.position, impact.normal, 0.0);
  if (length < scene.largest_radius) return;
  scene.length = length;
  scene.width = std::max(extent_along(scene, scene.position, impact.tangent(), 0.0), 2.0 * scene.largest_radius);
  const bool between = walls->support != CrushingWalls::kNone;
  walls->distance = between ? extent_along(scene, scene.position, impact.normal, 1.0) : length;
  scene.crushing_walls = walls;
}

bool has_support(const Scene& scene) {
  return scene.plates.present || (scene.crushing_walls && scene.crushing_walls->support != CrushingWalls::kNone);
}

Vector2 crush_direction_of(const Scene& scene) {
  if (scene.crushing_walls) return scene.rigid_walls[scene.crushing_walls->impact].normal;
  return Vector2::Unit(scene.plates.axis);
}

int crush_axis_of(const Scene& scene) {
  const Vector2 direction = crush_direction_of(scene).cwiseAbs();
  return direction.x() >= direction.y() ? 0 : 1;
}

double crush_speed_of(const Scene& scene) {
  if (!scene.crushing_walls) return scene.plates.speed;
  const RigidWall& impact = scene.rigid_walls[scene.crushing_walls->impact];
  const double of_run = scene.length / (static_cast<double>(scene.schedule.step_count) * scene.schedule.time_step);
  const double thrown = scene.initial_velocity.empty() ? 0.0 : -impact.normal.dot(scene.initial_velocity.front());
  return std::max({impact.speed + impact.speed_by_force(scene.length), greatest_slope_of(impact.motion),
                   greatest_of(impact.velocity), thrown, of_run});
}

double crush_travel_of(const Scene& scene, const State& state) {
  if (!scene.crushing_walls) return state.impact_travel;
  return std::max(0.0, scene.crushing_walls->distance - distance_of(scene, state));
}

double crush_strain_of(const Scene& scene, const State& state) {
  return is_crushed(scene) ? crush_travel_of(scene, state) / scene.length : 0.0;
}

double impact_impulse_of(const Scene& scene, const State& state) {
  if (scene.crushing_walls) return state.rigid_wall_totals[scene.crushing_walls->impact].normal;
  return state.impact_impulse + impulse_of_fixed(scene, state, Grip::FixedTo::impact_plate);
}

double support_impulse_of(const Scene& scene, const State& state) {
  if (!has_support(scene)) return 0.0;
  if (scene.crushing_walls) return state.rigid_wall_totals[scene.crushing_walls->support].normal;
  return state.support_impulse - impulse_of_fixed(scene, state, Grip::FixedTo::support_plate);
}

}  // namespace cellcrush
