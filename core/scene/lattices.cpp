#include "scene/lattices.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <type_traits>
#include <variant>

namespace cellcrush {
namespace {

using GridPoint = Eigen::Vector2i;
constexpr double kHalfRoot3 = 0.5 * std::numbers::sqrt3;

/// The points from (0, 0) to `last`, inclusive; some of them are joints.
struct Grid {
  GridPoint last;
  Vector2 spacing;  ///< mm
};

/// Spacing for hexagons: half pitches in x, half sides in y. For triangles: half sides in x, rows in y.
Grid grid_of(const SceneSpec& spec) {
  const RegularLattice& lattice = *regular_lattice_of(spec);
  const int columns = *lattice.columns;
  const int rows = *lattice.rows;
  const double side = *lattice.side_mm;
  if (std::holds_alternative<HexagonLattice>(spec.lattice)) {
    return {{2 * columns, 3 * rows + 1}, {kHalfRoot3 * side, 0.5 * side}};
  }
  if (std::holds_alternative<SquareLattice>(spec.lattice)) {
    return {{columns, rows}, {side, side}};
  }
  return {{2 * columns, rows}, {0.5 * side, kHalfRoot3 * side}};
}

/// A number for each point from (0, 0) to `last`, inclusive.
class Numbers {
 public:
  static constexpr int kNone = -1;

  explicit Numbers(const GridPoint& last)
      : columns_(last.x() + 1), number_(static_cast<std::size_t>(columns_) * (last.y() + 1), kNone) {}

  int& operator[](const GridPoint& point) {
    return number_[static_cast<std::size_t>(point.y()) * columns_ + point.x()];
  }

 private:
  int columns_;
  std::vector<int> number_;
};

/// Collects the walls of a lattice.
class LatticeBuilder {
 public:
  explicit LatticeBuilder(const SceneSpec& spec)
      : grid_(grid_of(spec)), joint_at_(grid_.last), wall_at_(2 * grid_.last), elements_(*spec.elements_per_wall) {}

  /// Adds a wall. Of a wall that two cells share, the greater thickness holds, and it is rigid if one of them is.
  void add_wall(const GridPoint& from, const GridPoint& to, double thickness, bool rigid = false) {
    int& number = wall_at_[from + to];  // twice the mid-point, at which there is no other wall
    if (number == Numbers::kNone) {
      number = static_cast<int>(layout_.walls.size());
      layout_.walls.push_back({joint(from), joint(to), thickness, elements_});
    }
    LayoutWall& wall = layout_.walls[number];
    wall.thickness = std::max(wall.thickness, thickness);
    wall.rigid = wall.rigid || rigid;
  }

  Layout take() { return std::move(layout_); }

 private:
  int joint(const GridPoint& point) {
    int& number = joint_at_[point];
    if (number == Numbers::kNone) {
      number = static_cast<int>(layout_.joints.size());
      layout_.joints.emplace_back(grid_.spacing.cwiseProduct(point.cast<double>()));
    }
    return number;
  }

  Grid grid_;
  Numbers joint_at_;
  Numbers wall_at_;
  int elements_;
  Layout layout_;
};

void add_hexagons(const HexagonLattice& lattice, const Inclusions& inclusions, LatticeBuilder& builder) {
  const double slanted = *lattice.wall_thickness_mm;
  const double upright = lattice.vertical_wall_thickness_mm.value_or(slanted);
  for (int row = 0; row < *lattice.rows; ++row) {
    const bool stiff = std::ranges::count(inclusions.rows, row + 1) > 0;
    const double factor = stiff ? inclusions.thickness_factor : 1.0;
    const bool rigid = stiff && inclusions.model == Inclusions::Model::rigid;
    const int shift = row % 2;  // odd rows are one cell shorter and are shifted by half a pitch
    for (int column = 0; column < *lattice.columns - shift; ++column) {
      const int x = 2 * column + shift;
      const int y = 3 * row;
      // Corners counter-clockwise from the lowest; walls 1-2 and 4-5 run along y.
      const std::array<GridPoint, 6> corner = {
          {{x + 1, y}, {x + 2, y + 1}, {x + 2, y + 3}, {x + 1, y + 4}, {x, y + 3}, {x, y + 1}}};
      for (int i = 0; i < 6; ++i) {
        builder.add_wall(corner[i], corner[(i + 1) % 6], factor * (i == 1 || i == 4 ? upright : slanted), rigid);
      }
    }
  }
}

void add_squares(const SquareLattice& lattice, LatticeBuilder& builder) {
  for (int y = 0; y <= *lattice.rows; ++y) {
    for (int x = 0; x <= *lattice.columns; ++x) {
      if (x < *lattice.columns) {
        builder.add_wall({x, y}, {x + 1, y}, *lattice.wall_thickness_mm);
      }
      if (y < *lattice.rows) {
        builder.add_wall({x, y}, {x, y + 1}, *lattice.wall_thickness_mm);
      }
    }
  }
}

void add_triangles(const TriangleLattice& lattice, LatticeBuilder& builder) {
  for (int y = 0; y <= *lattice.rows; ++y) {
    const int shift = y % 2;
    const int last = 2 * *lattice.columns - shift;
    for (int x = shift; x <= last; x += 2) {
      if (x < last) {
        builder.add_wall({x, y}, {x + 2, y}, *lattice.wall_thickness_mm);
      }
      for (const int upper : {x - 1, x + 1}) {
        const bool inside = upper >= 1 - shift && upper <= 2 * *lattice.columns - (1 - shift);
        if (y < *lattice.rows && inside) {
          builder.add_wall({x, y}, {upper, y + 1}, *lattice.wall_thickness_mm);
        }
      }
    }
  }
}

}  // namespace

const RegularLattice* regular_lattice_of(const SceneSpec& spec) {
  const auto regular = [](const auto& lattice) -> const RegularLattice* {
    if constexpr (std::is_base_of_v<RegularLattice, std::decay_t<decltype(lattice)>>) {
      return &lattice;
    }
    return nullptr;
  };
  return std::visit(regular, spec.lattice);
}

bool has_walls_along_crush(const SceneSpec& spec) {
  return std::holds_alternative<SquareLattice>(spec.lattice) || std::holds_alternative<TriangleLattice>(spec.lattice);
}

std::string path_of_lattice(const SceneSpec& spec) {
  constexpr std::array kPaths = {"lattice.", "lattice.hexagon.", "lattice.square.", "lattice.triangle."};
  return kPaths.at(spec.lattice.index());
}

double walls_per_cell_of(const SceneSpec& spec) {
  return std::holds_alternative<SquareLattice>(spec.lattice) ? 2.0 : 3.0;
}

Layout lay_out_cells(const SceneSpec& spec) {
  LatticeBuilder builder(spec);
  if (const auto* hexagons = std::get_if<HexagonLattice>(&spec.lattice)) {
    add_hexagons(*hexagons, spec.inclusions, builder);
  } else if (const auto* squares = std::get_if<SquareLattice>(&spec.lattice)) {
    add_squares(*squares, builder);
  } else {
    add_triangles(std::get<TriangleLattice>(spec.lattice), builder);
  }
  return builder.take();
}

Vector2 envelope_of(const SceneSpec& spec) {
  const Grid grid = grid_of(spec);
  return grid.spacing.cwiseProduct(grid.last.cast<double>());
}

double collapse_stress_of(const SceneSpec& spec) {
  const RegularLattice& lattice = *regular_lattice_of(spec);
  const double yield_stress = *spec.material.yield_stress_mpa;
  if (std::holds_alternative<HexagonLattice>(spec.lattice)) {
    const double slenderness = *lattice.wall_thickness_mm / *lattice.side_mm;
    return 2.0 / 3.0 * yield_stress * slenderness * slenderness;
  }
  if (std::holds_alternative<SquareLattice>(spec.lattice)) {
    return yield_stress * *lattice.wall_thickness_mm / *lattice.side_mm;
  }
  const bool is_along_walls = spec.loading.direction == LoadingSpec::Direction::x;
  const double factor = is_along_walls ? 2.0 / std::numbers::sqrt3 : std::numbers::sqrt3;
  return factor * yield_stress * *lattice.wall_thickness_mm / *lattice.side_mm;
}

}  // namespace cellcrush
