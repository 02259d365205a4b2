#include "synthetic_crush.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace cellcrush::client::testing {

namespace {

constexpr double kSide = 4.0;
constexpr double kDensified = 0.8;

struct Point {
  double x = 0.0;
  double y = 0.0;
};

// Nodes and elements of the undeformed lattice; joints are found by their position on a fine grid.
class Builder {
 public:
  Builder(int columns, int rows) {
    const double width = std::sqrt(3.0) * kSide;
    for (int row = 0; row < rows; ++row) {
      const int cells = row % 2 == 0 ? columns : columns - 1;
      for (int cell = 0; cell < cells; ++cell) {
        const Point centre{(cell + 0.5 + (row % 2 == 0 ? 0.0 : 0.5)) * width, (1.5 * row + 1.0) * kSide};
        for (int side = 0; side < 6; ++side) add_wall(corner(centre, side), corner(centre, side + 1));
      }
    }
  }

  std::vector<Point> points;
  std::vector<std::pair<int, int>> elements;

 private:
  static Point corner(const Point& centre, int index) {
    const double angle = (index + 0.5) * std::numbers::pi / 3.0;
    return {centre.x + kSide * std::cos(angle), centre.y + kSide * std::sin(angle)};
  }

  int node(const Point& point) {
    const auto key = std::pair(std::lround(point.x * 100), std::lround(point.y * 100));
    const auto [found, added] = nodes_.try_emplace(key, static_cast<int>(points.size()));
    if (added) points.push_back(point);
    return found->second;
  }

  void add_wall(const Point& a, const Point& b) {
    const int start = node(a);
    const int end = node(b);
    if (!walls_.insert(std::minmax(start, end)).second) return;
    const int middle = node({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)});
    elements.emplace_back(start, middle);
    elements.emplace_back(middle, end);
  }

  std::map<std::pair<long, long>, int> nodes_;
  std::set<std::pair<int, int>> walls_;
};

}  // namespace

MeshFrame synthetic_stage(int columns, int rows, double strain, bool along_y) {
  const Builder lattice(columns, rows);
  const double length = std::sqrt(3.0) * kSide * columns;
  const double width = (1.5 * rows + 0.5) * kSide;
  const double extent = along_y ? width : length;
  const double travel = strain * extent;
  const double front = travel / kDensified;
  MeshFrame stage;
  stage.frame.set_strain(strain);
  stage.frame.set_time_s(strain * extent * 1e-5);
  for (const Point& point : lattice.points) {
    double along = along_y ? point.y : point.x;
    double across = along_y ? point.x : point.y;
    if (along < front) {
      across += 0.9 * std::sin(along * 2.1) * std::cos(across * 0.7);
      along = travel + (1.0 - kDensified) * along;
    }
    stage.frame.add_position_mm(static_cast<float>(along_y ? across : along));
    stage.frame.add_position_mm(static_cast<float>(along_y ? along : across));
  }
  for (const auto& [start, end] : lattice.elements) {
    stage.mesh.add_element_nodes(start);
    stage.mesh.add_element_nodes(end);
    stage.mesh.add_thickness_mm(0.3464F);
    const Point& point = lattice.points[static_cast<std::size_t>(start)];
    const double behind = front - (along_y ? point.y : point.x);
    stage.frame.add_plastic_fraction(
        static_cast<float>(behind <= 0 ? 0.0 : 0.5 + 0.5 * std::sin(point.x + 2 * point.y)));
  }
  stage.mesh.set_particle_count(static_cast<int>(lattice.points.size()));
  stage.mesh.set_length_mm(extent);
  stage.mesh.set_width_mm(along_y ? length : width);
  stage.mesh.set_impact_plate_mm(0.0);
  stage.mesh.set_support_plate_mm(extent);
  stage.mesh.set_along_y(along_y);
  return stage;
}

std::vector<v1::Sample> synthetic_samples(int count, double end_strain) {
  std::vector<v1::Sample> samples;
  for (int i = 1; i <= count; ++i) {
    const double strain = end_strain * i / count;
    const double noise = std::sin(i * 1.7) * std::sin(i * 0.37);
    v1::Sample& sample = samples.emplace_back();
    sample.set_step(20 * i);
    sample.set_time_s(5.0e-3 * strain);
    sample.set_travel_mm(500.0 * strain);
    sample.set_strain(strain);
    sample.set_stress_impact_mpa(3.4 * (1.0 + 0.4 * noise) + 12.0 * std::exp(-strain / 0.01) +
                                 40.0 * std::exp((strain - 0.82) / 0.02));
    sample.set_stress_support_mpa(0.45 * (1.0 + 0.5 * noise) + 30.0 * std::exp((strain - 0.82) / 0.02));
  }
  return samples;
}

}  // namespace cellcrush::client::testing
