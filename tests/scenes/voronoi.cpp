#include "scenes/voronoi.h"

#include <algorithm>
#include <cstddef>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "cellcrush/vector.h"

namespace cellcrush::scenes {
namespace {

using Polygon = std::vector<Vector2>;

/// The part of a convex polygon that is nearer to one point than to another.
Polygon nearer_part(const Polygon& polygon, const Vector2& to, const Vector2& than) {
  const Vector2 middle = 0.5 * (to + than);
  const Vector2 outward = than - to;
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& here = polygon[i];
    const Vector2& next = polygon[(i + 1) % polygon.size()];
    const double height = outward.dot(here - middle);
    const double next_height = outward.dot(next - middle);
    if (height <= 0.0) part.push_back(here);
    if ((height < 0.0) != (next_height < 0.0)) part.push_back(here + height / (height - next_height) * (next - here));
  }
  return part;
}

/// Corners of cells, each once.
class Corners {
 public:
  int index_of(const Vector2& place) {
    constexpr double kRoundOff = 1e-7;  // mm
    const auto same = [&](const FrameWalls::Node& node) {
      return (Vector2(node.x_mm, node.y_mm) - place).norm() < kRoundOff;
    };
    const auto found = std::ranges::find_if(nodes, same);
    const auto index = static_cast<int>(found - nodes.begin());
    if (found == nodes.end()) nodes.push_back({place.x(), place.y(), 0.0, 0.0});
    return index;
  }
  std::vector<FrameWalls::Node> nodes;
};

}  // namespace

FrameWalls voronoi_foam(double length_mm, double width_mm, int cells, double relative_density, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto up_to = [&random](double limit) { return limit * static_cast<double>(random() >> 11U) * 0x1p-53; };
  std::vector<Vector2> points;
  for (int i = 0; i < cells; ++i) {
    const double x = up_to(length_mm);
    points.emplace_back(x, up_to(width_mm));
  }
  const auto on_border = [&](const Vector2& one, const Vector2& other) {
    return (one.x() == other.x() && (one.x() == 0.0 || one.x() == length_mm)) ||
           (one.y() == other.y() && (one.y() == 0.0 || one.y() == width_mm));
  };
  Corners corners;
  std::set<std::pair<int, int>> walls;
  double total = 0.0;
  for (const Vector2& point : points) {
    Polygon cell = {{0.0, 0.0}, {length_mm, 0.0}, {length_mm, width_mm}, {0.0, width_mm}};
    for (const Vector2& other : points) {
      if (&other != &point) cell = nearer_part(cell, point, other);
    }
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Vector2& start = cell[i];
      const Vector2& end = cell[(i + 1) % cell.size()];
      if (on_border(start, end)) continue;
      const auto wall = std::minmax({corners.index_of(start), corners.index_of(end)});
      if (wall.first != wall.second && walls.insert(wall).second) total += (end - start).norm();
    }
  }
  FrameWalls foam;
  foam.nodes = corners.nodes;
  const double thickness = relative_density * length_mm * width_mm / total;
  for (const auto& [start, end] : walls) {
    FrameWalls::Beam beam;
    beam.start = start;
    beam.end = end;
    beam.thickness_mm = thickness;
    foam.beams.push_back(beam);
  }
  return foam;
}

}  // namespace cellcrush::scenes
