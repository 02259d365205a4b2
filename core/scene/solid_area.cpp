#include "scene/solid_area.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "contact/topology/face_loops.h"

namespace cellcrush {
namespace {

/// An end of a wall at a joint.
struct WallEnd {
  double angle = 0.0;
  double thickness = 0.0;
  double length = 0.0;  ///< of the wall
};

/// What two neighbouring walls of a joint count twice, mm^2. The kite between their axes and the corner of their faces
/// is counted by both; a kite longer than a wall is cut at its end.
double overlap_of(const WallEnd& a, const WallEnd& b, double angle) {
  if (angle <= 0.0 || angle >= std::numbers::pi) return 0.0;
  const double along_a = 0.5 * (b.thickness + a.thickness * std::cos(angle)) / std::sin(angle);
  const double along_b = 0.5 * (a.thickness + b.thickness * std::cos(angle)) / std::sin(angle);
  return 0.25 * (a.thickness * std::clamp(along_a, 0.0, a.length) + b.thickness * std::clamp(along_b, 0.0, b.length));
}

/// Lengths of the walls that elements belong to, mm.
std::vector<double> wall_lengths_of(const Scene& scene) {
  std::vector<double> lengths;
  for (const Element& element : scene.elements) {
    lengths.push_back((scene.position[element.end] - scene.position[element.start]).norm());
  }
  for (const WallBlock& block : scene.walls.blocks) {
    for (int k = 0; k < block.walls * block.elements; ++k) {
      lengths[block.first_element + k] *= block.elements;
    }
  }
  return lengths;
}

double overlap_at(const Scene& scene, const std::vector<double>& lengths, int joint, std::vector<WallEnd>& ends) {
  ends.clear();
  for (int k = scene.incidence_offset[joint]; k < scene.incidence_offset[joint + 1]; ++k) {
    const Element& element = scene.elements[scene.incidence[k]];
    const double length = lengths[scene.incidence[k]];
    const int other = element.start == joint ? element.end : element.start;
    const Vector2 away = scene.position[other] - scene.position[joint];
    ends.push_back({std::atan2(away.y(), away.x()), element.thickness, length});
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
  const double thickness = scene.elements[scene.rigid.first_element].thickness;
  double voids = 0.0;
  for (const FaceLoop& cell : trace_loops(scene.position, scene.elements)) {
    const std::vector<int>& corners = cell.particle;
    if (cell.area <= 0.0 || !is_rigid(scene.rigid, corners)) continue;
    double covered = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto place = [&](std::size_t corner) { return scene.position[corners[corner % corners.size()]]; };
      const Vector2 wall = place(i + 1) - place(i);
      const Vector2 next = place(i + 2) - place(i + 1);
      const double turn = std::atan2(cross(wall, next), wall.dot(next));  // the cell is on the left
      covered += 0.5 * thickness * wall.norm() - 0.25 * thickness * thickness * std::max(0.0, std::tan(0.5 * turn));
    }
    voids += std::max(0.0, cell.area - covered);
  }
  return voids;
}

}  // namespace

double solid_area_of(const Scene& scene) {
  double area = rigid_voids_of(scene);
  for (const Element& element : scene.elements) {
    area += element.thickness * (scene.position[element.end] - scene.position[element.start]).norm();
  }
  const std::vector<double> lengths = wall_lengths_of(scene);
  std::vector<WallEnd> ends;
  for (int joint = 0; joint < scene.joint_count; ++joint) {
    area -= overlap_at(scene, lengths, joint, ends);
  }
  return area;
}

double solid_fraction_at(const Scene& scene, double strain) {
  return scene.solid_area / (scene.length * scene.width * (1.0 - strain));
}

double closing_strain_of(double solid_area, double envelope) {
  return std::max(0.0, 1.0 - solid_area / (kClosed * envelope));
}

std::optional<double> closing_strain_of(const Scene& scene) {
  if (!scene.plates.present || scene.solid_area <= 0.0) return std::nullopt;
  return closing_strain_of(scene.solid_area, scene.length * scene.width);
}

bool is_past_closing(const Scene& scene, double strain) {
  const std::optional<double> closed = closing_strain_of(scene);
  return closed && strain > *closed + scene.plates.speed * scene.schedule.time_step / scene.length;
}

double solid_fraction_between_walls(const Scene& scene, std::span<const Vector2> position,
                                    std::span<const RigidWallMotion> motions) {
  constexpr double kFacing = -0.999;  // cosine between their normals
  const auto extent_along = [&](const Vector2& axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < position.size(); ++i) {
      low = std::min(low, axis.dot(position[i]) - scene.radius[i]);
      high = std::max(high, axis.dot(position[i]) + scene.radius[i]);
    }
    return high - low;
  };
  const auto face_of = [&](std::size_t wall) -> Vector2 {
    const RigidWall& of = scene.rigid_walls[wall];
    return of.point + (motions.empty() ? 0.0 : motions[wall].travel) * of.normal;
  };
  double fraction = 0.0;
  for (std::size_t a = 0; a < scene.rigid_walls.size(); ++a) {
    const Vector2& normal = scene.rigid_walls[a].normal;
    for (std::size_t b = a + 1; b < scene.rigid_walls.size(); ++b) {
      const double gap = normal.dot(face_of(b) - face_of(a));
      if (gap <= 0.0 || normal.dot(scene.rigid_walls[b].normal) > kFacing) continue;
      const double depth = std::min(gap, extent_along(normal));
      fraction = std::max(fraction, scene.solid_area / (depth * extent_along(scene.rigid_walls[a].tangent())));
    }
  }
  return fraction;
}

}  // namespace cellcrush
