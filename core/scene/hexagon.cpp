#include "scene/hexagon.h"

#include <array>
#include <map>
#include <numbers>
#include <utility>

namespace cellcrush {
namespace {

// Joints lie on a grid of half pitches (sqrt(3)/2 side) in x and half sides in y, where each has whole coordinates.
using GridPoint = std::pair<int, int>;

class LayoutBuilder {
 public:
  LayoutBuilder(double side, int elements_per_wall) : side_(side), elements_per_wall_(elements_per_wall) {}

  void add_wall(GridPoint from, GridPoint to, double thickness) {
    const int start = joint(from);
    const int end = joint(to);
    if (walls_.emplace(std::minmax(start, end), true).second) {
      layout_.walls.push_back({start, end, thickness, elements_per_wall_});
    }
  }

  Layout take() { return std::move(layout_); }

 private:
  int joint(GridPoint point) {
    const auto [entry, is_new] = joints_.emplace(point, static_cast<int>(layout_.joints.size()));
    if (is_new) {
      layout_.joints.emplace_back(0.5 * std::numbers::sqrt3 * side_ * point.first, 0.5 * side_ * point.second);
    }
    return entry->second;
  }

  double side_;
  int elements_per_wall_;
  Layout layout_;
  std::map<GridPoint, int> joints_;
  std::map<std::pair<int, int>, bool> walls_;
};

}  // namespace

Layout lay_out_hexagons(const HexagonLattice& lattice, int elements_per_wall) {
  const double slanted = *lattice.wall_thickness_mm;
  const double vertical = lattice.vertical_wall_thickness_mm.value_or(slanted);
  LayoutBuilder builder(*lattice.side_mm, elements_per_wall);
  for (int row = 0; row < *lattice.rows; ++row) {
    const int shift = row % 2;  // odd rows are one cell shorter and start half a pitch in
    for (int column = 0; column < *lattice.columns - shift; ++column) {
      const int x = 2 * column + shift;
      const int y = 3 * row;
      // Corners counter-clockwise from the lowest; walls 1-2 and 4-5 stand along y.
      const std::array<GridPoint, 6> corner = {
          {{x + 1, y}, {x + 2, y + 1}, {x + 2, y + 3}, {x + 1, y + 4}, {x, y + 3}, {x, y + 1}}};
      for (int i = 0; i < 6; ++i) {
        builder.add_wall(corner[i], corner[(i + 1) % 6], i == 1 || i == 4 ? vertical : slanted);
      }
    }
  }
  return builder.take();
}

Vector2 envelope_of(const HexagonLattice& lattice) {
  return {std::numbers::sqrt3 * *lattice.side_mm * *lattice.columns, (1.5 * *lattice.rows + 0.5) * *lattice.side_mm};
}

}  // namespace cellcrush
