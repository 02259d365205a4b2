#include "scene/solid_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "measure/crush_mode.h"

namespace cellcrush {
namespace {

/// An end of a wall at a joint.
struct WallEnd {
  double angle = 0.0;
  double thickness = 0.0;
  double length = 0.0;  ///< of the element
};

/// What two neighbouring walls of a joint count twice, mm^2. The kite between their axes and the corner of their faces
/// is counted by both; a kite longer than an element is cut at its end.
double overlap_of(const WallEnd& a, const WallEnd& b, double angle) {
  if (angle <= 0.0 || angle >= std::numbers::pi) return 0.0;
  const double along_a = 0.5 * (b.thickness + a.thickness * std::cos(angle)) / std::sin(angle);
  const double along_b = 0.5 * (a.thickness + b.thickness * std::cos(angle)) / std::sin(angle);
  return 0.25 * (a.thickness * std::clamp(along_a, 0.0, a.length) + b.thickness * std::clamp(along_b, 0.0, b.length));
}

double overlap_at(const Scene& scene, int joint, std::vector<WallEnd>& ends) {
  ends.clear();
  for (int k = scene.incidence_offset[joint]; k < scene.incidence_offset[joint + 1]; ++k) {
    const Element& element = scene.elements[scene.incidence[k]];
    const int other = element.start == joint ? element.end : element.start;
    const Vector2 away = scene.position[other] - scene.position[joint];
    ends.push_back({std::atan2(away.y(), away.x()), element.thickness, away.norm()});
  }
  if (ends.size() < 2) return 0.0;
  std::ranges::sort(ends, {}, &WallEnd::angle);
  double overlap = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const bool last = i + 1 == ends.size();
    const WallEnd& next = ends[last ? 0 : i + 1];
    overlap += overlap_of(ends[i], next, next.angle - ends[i].angle + (last ? 2.0 * std::numbers::pi : 0.0));
  }
  return overlap;
}

/// Whether all corners of a cell belong to one rigid body.
bool is_rigid(const RigidBodies& rigid, std::span<const int> corners) {
  const auto body_of = [&](int particle) { return std::ranges::upper_bound(rigid.offset, particle); };
  return std::ranges::all_of(corners, [&](int corner) {
    return corner < rigid.particle_count() && body_of(corner) == body_of(corners.front());
  });
}

/// Voids of the cells of rigid bodies, mm^2: their areas less the halves of the walls round them, which overlap at the
/// corners.
double rigid_voids_of(const Scene& scene) {
  if (scene.rigid.particle_count() == 0) return 0.0;
  const Faces cells = trace_faces(scene.position, scene.elements);
  const double thickness = scene.elements[scene.rigid.first_element].thickness;
  double voids = 0.0;
  for (std::size_t cell = 0; cell < cells.count(); ++cell) {
    const std::span<const int> corners = cells.particles_of(cell);
    if (!is_rigid(scene.rigid, corners)) continue;
    double covered = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto place = [&](std::size_t corner) { return scene.position[corners[corner % corners.size()]]; };
      const Vector2 wall = place(i + 1) - place(i);
      const Vector2 next = place(i + 2) - place(i + 1);
      const double turn = std::atan2(cross(wall, next), wall.dot(next));  // the cell is on the left
      covered += 0.5 * thickness * wall.norm() - 0.25 * thickness * thickness * std::max(0.0, std::tan(0.5 * turn));
    }
    voids += std::max(0.0, cells.area[cell] - covered);
  }
  return voids;
}

}  // namespace

double solid_area_of(const Scene& scene) {
  double area = rigid_voids_of(scene);
  for (const Element& element : scene.elements) {
    area += element.thickness * (scene.position[element.end] - scene.position[element.start]).norm();
  }
  std::vector<WallEnd> ends;
  for (int joint = 0; joint < scene.joint_count; ++joint) {
    area -= overlap_at(scene, joint, ends);
  }
  return area;
}

double solid_fraction_at(const Scene& scene, double strain) {
  return scene.solid_area / (scene.length * scene.width * (1.0 - strain));
}

std::optional<double> closing_strain_of(const Scene& scene) {
  const double envelope = scene.length * scene.width;
  if (envelope <= 0.0) return std::nullopt;
  return 1.0 - scene.solid_area / (kClosed * envelope);
}

bool is_past_closing(const Scene& scene, double strain) {
  return strain > *closing_strain_of(scene) + scene.plates.speed * scene.schedule.time_step / scene.length;
}

}  // namespace cellcrush
