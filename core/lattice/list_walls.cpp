#include "lattice/list_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "fields/field_checker.h"
#include "lattice/cut_walls.h"
#include "lattice/grade_walls.h"
#include "lattice/lattice.h"
#include "lattice/layout.h"
#include "lattice/network.h"
#include "lattice/period.h"
#include "lattice/remove_walls.h"
#include "lattice/voronoi.h"

namespace cellcrush {
namespace {

std::string counted(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string words_of(const Islands& islands) {
  return islands.count == 0 ? ""
                            : ", without " + counted(islands.walls, "wall") + " in " + counted(islands.count, "island");
}

/// The walls of the lattice before any change, and what they are, in a sentence.
std::pair<Layout, std::string> lay_out_unchanged(const SceneSpec& spec) {
  if (const auto* lattice = std::get_if<VoronoiWalls>(&spec.lattice)) {
    VoronoiLayout made = lay_out_voronoi(*lattice, repeated_axis_of(spec));
    std::string words = "Voronoi honeycomb of " + std::to_string(*lattice->columns * *lattice->rows) + " cells, " +
                        counted(static_cast<int>(made.layout.walls.size()), "wall") + " of " + to_text(made.thickness) +
                        " mm" + words_of(made.islands);
    return {std::move(made.layout), std::move(words)};
  }
  const auto* network = std::get_if<NetworkWalls>(&spec.lattice);
  const LatticeKind* kind = kind_of(spec);
  Layout layout = network != nullptr ? lay_out_network(*network) : kind->lay_out(spec);
  std::string words = network != nullptr ? "network" : std::string(kind->plural);
  words += " of " + counted(static_cast<int>(layout.walls.size()), "wall");
  return {std::move(layout), std::move(words)};
}

void rotate(double degrees, Layout& layout) {
  if (degrees == 0.0) return;
  const Turn turn = turn_by(degrees);
  const Box box = box_around(layout.joints);
  const Vector2 centre = 0.5 * (box.low + box.high);
  for (Vector2& joint : layout.joints) {
    const Vector2 arm = joint - centre;
    joint = centre + Vector2(turn.cosine * arm.x() - turn.sine * arm.y(), turn.sine * arm.x() + turn.cosine * arm.y());
  }
}

/// Empty without an outline.
Polygon polygon_of(const Outline& outline) {
  Polygon corners;
  for (std::size_t i = 0; i + 1 < outline.corners_mm.size(); i += 2) {
    corners.emplace_back(outline.corners_mm[i], outline.corners_mm[i + 1]);
  }
  return corners.size() == 2 ? rectangle_between(corners[0], corners[1]) : corners;
}

/// The network of a layout, with the materials of the one it was made from.
NetworkWalls network_of(const Layout& layout, const SceneSpec& spec) {
  NetworkWalls network;
  if (const auto* given = std::get_if<NetworkWalls>(&spec.lattice)) network.materials = given->materials;
  for (const Vector2& joint : layout.joints) {
    network.joints_mm.insert(network.joints_mm.end(), {joint.x(), joint.y()});
  }
  for (const LayoutWall& wall : layout.walls) {
    network.walls.insert(network.walls.end(), {wall.start, wall.end});
    network.thicknesses_mm.push_back(wall.thickness);
    network.rises_mm.push_back(wall.rise);
    network.wall_materials.push_back(wall.material);
  }
  const auto is_zero = [](auto value) { return value == 0; };
  if (std::ranges::all_of(network.rises_mm, is_zero)) network.rises_mm.clear();
  if (std::ranges::all_of(network.wall_materials, is_zero)) network.wall_materials.clear();
  return network;
}

/// Changes the walls, and says how.
void change(const LatticeChanges& changes, Layout& layout, std::string& words, Problems& problems) {
  const Polygon polygon = polygon_of(changes.outline);
  const auto range = [&] { return box_around(polygon.empty() ? layout.joints : polygon); };
  rotate(changes.rotation_degrees, layout);
  if (changes.rotation_degrees != 0.0) words += "; turned by " + to_text(changes.rotation_degrees) + " degrees";
  const Box box = range();
  grade_sizes(changes.grading, box, layout);
  if (size_factors(changes.grading).are_given()) words += "; sizes graded";
  const bool has_arcs = std::ranges::any_of(layout.walls, [](const LayoutWall& wall) { return wall.rise != 0.0; });
  if (!polygon.empty() && has_arcs) {
    problems.push_back({"lattice.outline.corners_mm", "", "cannot cut walls that are arcs.",
                        "Remove the outline, or give the arcs as straight walls."});
    return;
  }
  if (!polygon.empty()) {
    const Islands islands = cut_at(polygon, changes.outline.edge_wall_thickness_mm, layout);
    words += "; cut at the outline to " + counted(static_cast<int>(layout.walls.size()), "wall") + words_of(islands);
  }
  if (layout.walls.empty()) {
    problems.push_back({"lattice.outline.corners_mm", "", "leaves no wall of the lattice.",
                        "Give corners around walls: the lower left corner of the lattice is the origin."});
    return;
  }
  grade_thicknesses(changes.grading, box, layout);
  if (thickness_factors(changes.grading).are_given()) words += "; thicknesses graded";
  scatter_thicknesses(changes.defects, layout);
  if (changes.defects.thickness_scatter != 0.0) {
    words += "; thicknesses scattered by up to " + to_text(100.0 * changes.defects.thickness_scatter) + " %";
  }
  const Removal removal = remove_walls(changes.defects, layout);
  if (removal.walls == 0) return;
  words += "; " + counted(removal.walls, "wall") + " missing, none of which splits the lattice, " +
           counted(removal.free_ends, "free end") + " left";
}

}  // namespace

bool has_made_walls(const SceneSpec& spec) {
  return std::holds_alternative<VoronoiWalls>(spec.lattice) ||
         (!std::holds_alternative<FrameWalls>(spec.lattice) && spec.changes != LatticeChanges());
}

ListedWalls list_walls(const SceneSpec& spec) {
  ListedWalls listed = {spec, {}, {}};
  if (!has_made_walls(spec)) return listed;
  auto [layout, words] = lay_out_unchanged(spec);
  if (std::ranges::any_of(layout.walls, [](const LayoutWall& wall) { return wall.bow != 0.0; })) {
    const std::string path = path_of_lattice(spec);
    listed.problems.push_back({path.substr(0, path.size() - 1), "",
                               "has curved walls, which defects, grading, rotation or outline would straighten.",
                               "Remove these, or take another lattice."});
    return listed;
  }
  if (const double period = period_of(spec); period > 0.0) {
    const int axis = *repeated_axis_of(spec);
    const Unclosed unclosed = close_period(axis, period, layout);
    const bool is_voronoi = std::holds_alternative<VoronoiWalls>(spec.lattice);
    if (is_voronoi && (unclosed.wide_joint >= 0 || layout.images.empty())) {
      listed.problems.push_back({std::string("lattice.voronoi.") + (axis == 0 ? "columns" : "rows"), "",
                                 "are too few: walls are longer than half of the period (loading.sides PERIODIC).",
                                 "Give more."});
      return listed;
    }
    listed.spec.loading.sides.period_mm = period;
  }
  change(spec.changes, layout, words, listed.problems);
  listed.words = "Walls: " + words + ".";
  listed.spec.lattice = network_of(layout, spec);
  listed.spec.changes = {};
  listed.spec.inclusions = {};
  return listed;
}

void name_made_walls(const SceneSpec& given, Problems& problems) {
  if (!has_made_walls(given)) return;
  for (Problem& problem : problems) {
    if (problem.field.starts_with("lattice.network.")) problem.field = "lattice";
  }
}

// The mathematics library of a machine may round the last bit of a cosine otherwise.
Turn turn_by(double degrees) {
  const double quarters = std::round(degrees / 90.0);
  const double angle = (degrees - 90.0 * quarters) * (std::numbers::pi / 180.0);  // up to pi/4
  constexpr int kLastPower = 20;                                                  // x^20 / 20! is below 1e-20
  double cosine = 1.0;
  double sine = 0.0;
  double term = 1.0;  // x^power / power!
  for (int power = 1; power <= kLastPower; ++power) {
    term *= angle / power;
    const double signed_term = power % 4 < 2 ? term : -term;
    (power % 2 == 0 ? cosine : sine) += signed_term;
  }
  switch (static_cast<int>(quarters) & 3) {
    case 1: return {-sine, cosine};
    case 2: return {-cosine, -sine};
    case 3: return {sine, -cosine};
    default: return {cosine, sine};
  }
}

}  // namespace cellcrush
