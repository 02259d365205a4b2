#include "scene/shortening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cellcrush {
namespace {

double duration_of(const Scene& scene) {
  return scene.schedule.time_step * static_cast<double>(scene.schedule.step_count);
}

Vector2 extent_of(const Scene& scene) {
  Vector2 low = scene.position.front();
  Vector2 high = low;
  for (const Vector2& place : scene.position) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  return high - low + Vector2::Constant(2.0 * scene.largest_radius);
}

/// Smallest and greatest of what parts of the lattice do, with 0 of those at rest.
struct Range {
  Vector2 low = Vector2::Zero();
  Vector2 high = Vector2::Zero();

  void include(const Vector2& value) {
    low = low.cwiseMin(value);
    high = high.cwiseMax(value);
  }
  [[nodiscard]] double share_of(const Vector2& extent) const { return (high - low).cwiseQuotient(extent).maxCoeff(); }
};

/// Calls visit(value) for the points of a function until a time, and for that time.
template <class Visit>
void visit_values(const TimeFunction& function, double end, const Visit& visit) {
  for (const auto& [time, value] : function.points) {
    if (time < end) visit(value);
  }
  visit(function.value_at(end));
}

double imposed_share(const Scene& scene, const Vector2& extent) {
  const double end = duration_of(scene);
  Range travel;
  double turn = 0.0;
  for (const Support& support : scene.supports) {
    const auto visit = [&](const Hold& hold, const auto& use) {
      if (hold.motion >= 0) visit_values(scene.motions[hold.motion], end, use);
    };
    visit(support.x, [&](double value) { travel.include({value, 0.0}); });
    visit(support.y, [&](double value) { travel.include({0.0, value}); });
    visit(support.rotation, [&](double value) { turn = std::max(turn, std::abs(value) / std::numbers::pi); });
  }
  for (const RigidWall& wall : scene.rigid_walls) {
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < scene.particle_count(); ++i) {
      gap = std::min(gap, wall.normal.dot(scene.position[i] - wall.point) - scene.radius[i]);
    }
    visit_values(wall.motion, end, [&](double value) { travel.include(std::max(0.0, value - gap) * wall.normal); });
  }
  return std::max(turn, travel.share_of(extent));
}

/// W, N mm; a moment turns by a quarter.
double work_of_loads(const Scene& scene, const Vector2& extent) {
  double work = 0.0;
  const auto add = [&](const TimeFunction& value, Component component, double factor) {
    double most = 0.0;
    visit_values(value, duration_of(scene), [&](double each) { most = std::max(most, factor * std::abs(each)); });
    work +=
        most * (component == Component::rotation ? std::numbers::pi / 2.0 : extent[component == Component::x ? 0 : 1]);
  };
  for (const NodalLoad& load : scene.loads) add(load.value, load.component, 1.0);
  for (const ElementLoad& load : scene.element_loads) add(load.value, load.component, load.length);
  double mass = scene.total_mass;
  for (const RigidWall& wall : scene.rigid_walls) mass += wall.mass;
  return work + mass * scene.gravity.cwiseAbs().dot(extent);
}

/// D, N mm. A lattice of hexagons takes 2.3 times the plastic moments of its walls.
double work_to_fold(const Scene& scene) {
  double sum = 0.0;
  for (const WallBlock& block : scene.walls.blocks) {
    for (int w = block.first_wall; w < block.first_wall + block.walls; ++w) {
      const Material& material = scene.materials[scene.walls.material[w]];
      const double square = scene.depth * scene.walls.thickness[w] * scene.walls.thickness[w];
      const double length = scene.walls.undeformed_length[w] * block.elements;
      sum += std::min(material.yield_stress * square / 4.0,
                      material.youngs_modulus * square * scene.walls.thickness[w] / (6.0 * length));
    }
  }
  return 2.0 * sum;
}

double driven_share(const Scene& scene, const Vector2& extent) {
  Range speed;
  double energy = 0.0;
  for (std::size_t i = 0; i < scene.initial_velocity.size(); ++i) {
    speed.include(scene.initial_velocity[i]);
    energy += scene.mass[i] * scene.initial_velocity[i].squaredNorm() / 2.0;
  }
  for (const RigidWall& wall : scene.rigid_walls) {
    if (wall.mass == 0.0) continue;
    const double fastest = wall.speed + wall.speed_by_force(extent.norm());
    speed.include(wall.mass / (wall.mass + scene.total_mass / 2.0) * fastest * wall.normal);
    energy += wall.mass * fastest * fastest / 2.0;
  }
  const double surplus = work_of_loads(scene, extent) - work_to_fold(scene);
  const double of_loads = std::sqrt(std::max(0.0, surplus) / scene.total_mass) / extent.maxCoeff();
  const double flight = duration_of(scene) * (speed.share_of(extent) + of_loads);
  return surplus < 0.0 ? std::min(flight, energy / -surplus) : flight;
}

}  // namespace

double shortening_of(const Scene& scene) {
  const Vector2 extent = extent_of(scene);
  return std::min(1.0, std::max(imposed_share(scene, extent), driven_share(scene, extent)));
}

}  // namespace cellcrush
