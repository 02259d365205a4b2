#include "lattice/period.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "fields/field_checker.h"
#include "geometry/bucket_grid.h"
#include "lattice/lattice.h"
#include "lattice/network.h"
#include "lattice/voronoi.h"

namespace cellcrush {
namespace {

constexpr int kNone = -1;
constexpr double kSamePlace = 1e-6;  // of the period
constexpr const char* kPeriod = "loading.sides.period_mm";

int axis_across(const SceneSpec& spec) { return spec.loading.direction == LoadingSpec::Direction::x ? 1 : 0; }

/// For each joint the one of which it is the image, or kNone.
std::vector<int> originals_of(int axis, double length, const std::vector<Vector2>& joints) {
  std::vector<int> original(joints.size(), kNone);
  const BucketGrid grid(joints, 0.01 * length);
  const Vector2 margin = Vector2::Constant(kSamePlace * length);
  for (std::size_t image = 0; image < joints.size(); ++image) {
    Vector2 place = joints[image];
    place[axis] -= length;
    grid.visit_box(place - margin, place + margin, [&](int joint) {
      if (((joints[joint] - place).cwiseAbs().array() <= margin.array()).all()) original[image] = joint;
    });
  }
  return original;
}

/// Removes joints without walls.
void drop_loose_joints(Layout& layout) {
  std::vector<int> number(layout.joints.size(), kNone);
  for (const LayoutWall& wall : layout.walls) number[wall.start] = number[wall.end] = 0;
  std::vector<Vector2> joints;
  for (std::size_t joint = 0; joint < number.size(); ++joint) {
    if (number[joint] == kNone) continue;
    number[joint] = static_cast<int>(joints.size());
    joints.push_back(layout.joints[joint]);
  }
  layout.joints = std::move(joints);
  for (LayoutWall& wall : layout.walls) {
    wall.start = number[wall.start];
    wall.end = number[wall.end];
  }
}

void check_period_of_network(const SceneSpec& spec, FieldChecker& check) {
  const auto& network = std::get<NetworkWalls>(spec.lattice);
  if (!check.within_limits(kPeriod, spec.loading.sides.period_mm)) return;
  const double length = *spec.loading.sides.period_mm;
  Layout layout = lay_out_network(network);
  const Unclosed unclosed = close_period(axis_across(spec), length, layout);
  if (unclosed.wide_joint != kNone) {
    check.add(kPeriod, to_text(length), "is less than half of the network's width.",
              "Give joints and walls of one period only, and joints at the other side where walls end there.");
  } else if (unclosed.image_wall != kNone) {
    check.add("lattice.network.walls[" + std::to_string(2 * unclosed.image_wall) + "]", "",
              "begins a wall that is the image of wall " + std::to_string(unclosed.wall) + ", a period further on.",
              "Remove one of the two: with periodic sides each wall stands once.");
  } else if (layout.images.empty()) {
    check.add(kPeriod, to_text(length), "is not the distance across the crush of any two joints.",
              "Give the distance of joints at one side from their images at the other, at the same height to a "
              "millionth of it.");
  }
}

void check_other_loads(const SceneSpec& spec, FieldChecker& check) {
  if (!spec.loads.grips.empty()) {
    check.add("loading.grips", std::to_string(spec.loads.grips.size()), "would hold sides that repeat.",
              "Remove the grips, or set loading.sides.kind to FREE or RIGID.");
  }
  for (std::size_t i = 0; i < spec.loads.rigid_walls.size(); ++i) {
    const LoadsSpec::RigidWall& wall = spec.loads.rigid_walls[i];
    const int axis = axis_across(spec);
    if (wall.edge && axis_of(*wall.edge) == axis) {
      check.add("loading.rigid_walls[" + std::to_string(i) + "].edge", "",
                "is across the crush, where the lattice repeats without end.",
                "Give the wall an edge along the crush, or set loading.sides.kind to FREE or RIGID.");
    }
    if (const double across = axis == 0 ? wall.normal_x : wall.normal_y; across != 0.0) {
      check.add("loading.rigid_walls[" + std::to_string(i) + "].normal_" + (axis == 0 ? "x" : "y"), to_text(across),
                "is across the crush, where the lattice repeats without end.",
                "Set it to 0, or loading.sides.kind to FREE or RIGID.");
    }
  }
}

void check_other_shapes(const SceneSpec& spec, FieldChecker& check) {
  const char* const kUneven = "would not repeat with the sides (loading.sides PERIODIC).";
  const LatticeChanges& changes = spec.changes;
  if (changes.rotation_degrees != 0.0) {
    check.add("lattice.rotation_degrees", to_text(changes.rotation_degrees), kUneven, "Set it to 0.");
  }
  if (!changes.outline.corners_mm.empty()) {
    check.add("lattice.outline.corners_mm", "", kUneven, "Remove the outline.");
  }
  if (!changes.grading.size_steps.empty()) {
    check.add("lattice.grading.size_steps", "", kUneven, "Grade thicknesses, or remove it.");
  }
  if (!changes.grading.size_polynomial.empty()) {
    check.add("lattice.grading.size_polynomial", "", kUneven, "Grade thicknesses, or remove it.");
  }
  if (spec.inclusions.model == Inclusions::Model::rigid && !spec.inclusions.rows.empty()) {
    check.add("lattice.inclusions.model", "RIGID", "does not go with periodic sides, which rows of cells cross.",
              "Set it to MESHED.");
  }
}

}  // namespace

bool repeats_along(const SceneSpec& spec, int axis) {
  return spec.loading.sides.kind == LoadingSpec::Sides::Kind::periodic && axis == axis_across(spec);
}

std::optional<int> repeated_axis_of(const SceneSpec& spec) {
  const int axis = axis_across(spec);
  return repeats_along(spec, axis) ? std::optional(axis) : std::nullopt;
}

double period_of(const SceneSpec& spec) {
  if (!repeats_along(spec, axis_across(spec))) return 0.0;
  if (const auto* voronoi = std::get_if<VoronoiWalls>(&spec.lattice)) return envelope_of(*voronoi)[axis_across(spec)];
  if (const LatticeKind* kind = kind_of(spec)) return kind->period(*regular_lattice_of(spec))[axis_across(spec)];
  return spec.loading.sides.period_mm.value_or(0.0);
}

Unclosed close_period(int axis, double length, Layout& layout) {
  Unclosed unclosed;
  const std::vector<int> original = originals_of(axis, length, layout.joints);
  std::map<std::pair<int, int>, int> wall_at;
  for (std::size_t wall = 0; wall < layout.walls.size(); ++wall) {
    wall_at.emplace(std::minmax(layout.walls[wall].start, layout.walls[wall].end), static_cast<int>(wall));
  }
  std::vector<LayoutWall> once;
  for (std::size_t wall = 0; wall < layout.walls.size(); ++wall) {
    const auto ends = std::minmax(original[layout.walls[wall].start], original[layout.walls[wall].end]);
    const auto found = ends.first == kNone ? wall_at.end() : wall_at.find(ends);
    if (found == wall_at.end()) {
      once.push_back(layout.walls[wall]);
    } else if (unclosed.image_wall == kNone) {
      unclosed.image_wall = static_cast<int>(wall);
      unclosed.wall = found->second;
    }
  }
  layout.walls = std::move(once);
  drop_loose_joints(layout);
  const std::vector<int> left = originals_of(axis, length, layout.joints);
  for (std::size_t image = 0; image < left.size(); ++image) {
    if (left[image] == kNone) continue;
    layout.images.emplace_back(left[image], static_cast<int>(image));
    if (left[left[image]] != kNone) unclosed.wide_joint = left[image];
  }
  align_images(axis, length, layout);
  return unclosed;
}

void align_images(int axis, double length, Layout& layout) {
  for (const auto& [low, high] : layout.images) {
    layout.joints[high] = layout.joints[low];
    layout.joints[high][axis] += length;
  }
}

void check_period(const SceneSpec& spec, FieldChecker& check) {
  const LoadingSpec::Sides& sides = spec.loading.sides;
  const bool is_network = std::holds_alternative<NetworkWalls>(spec.lattice);
  if (const LatticeKind* kind = kind_of(spec)) {
    const RegularLattice& lattice = *regular_lattice_of(spec);
    if (kind->period(lattice)[axis_across(spec)] == 0.0) {
      const bool along_x = axis_across(spec) == 0;
      check.add(path_of_lattice(spec) + (along_x ? "columns" : "rows"),
                std::to_string(along_x ? *lattice.columns : *lattice.rows),
                "is odd: cells would not meet those of the next period (loading.sides PERIODIC).",
                "Give an even number.");
    }
  } else if (is_network) {
    check_period_of_network(spec, check);
  } else if (std::holds_alternative<FrameWalls>(spec.lattice)) {
    check.add("loading.sides.kind", "PERIODIC", "is not available for frames.",
              "Set it to FREE or RIGID, or give the walls as lattice.network.");
  }
  if (sides.period_mm && !is_network) {
    check.add(kPeriod, to_text(*sides.period_mm), "is for networks: other lattices repeat after their columns or rows.",
              "Remove it.");
  }
  check_other_loads(spec, check);
  check_other_shapes(spec, check);
}

}  // namespace cellcrush
