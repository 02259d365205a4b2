#include "drawing/join_walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "drawing/lattice_marks.h"
#include "drawing/wall_geometry.h"
#include "drawing/wall_grid.h"

namespace cellcrush::drawing {
namespace {

/// Largest size of a drawing over its tolerance: places have sixteen digits.
constexpr double kWidest = 1e12;
/// Most pairs of walls, and of a joint and a wall, that lie near each other.
constexpr long kMostPairs = 100'000'000;
/// As the field lattice.network.walls.
constexpr std::size_t kMostWalls = 200'000;

/// A wall in mm with the joints that its ends have become.
struct Wall {
  int start = 0;
  int end = 0;
  double rise = 0.0;
  double thickness = 0.0;
};

/// Joints that divide a wall, by their share of its length.
using Cuts = std::set<std::pair<double, int>>;

class Joiner {
 public:
  Joiner(const Drawing& drawing, const JoinOptions& options) : options_(options) {
    scale(drawing);
    out_.bonds = bond_walls(options.bond, lines_);
    out_.tolerance_mm = options.tolerance_mm.value_or(kTolerance * shortest_);
    if (!(out_.tolerance_mm > 0.0)) refuse("The tolerance is 0 mm. Give a positive one (--tolerance).");
    if (!(farthest_ <= kWidest * out_.tolerance_mm)) {
      refuse(
          fmt::format("The drawing reaches to {:.3g} mm, and its ends are one joint within {:.3g} mm. Check the unit "
                      "and the shortest line, or give a larger tolerance (--tolerance).",
                      farthest_, out_.tolerance_mm));
    }
  }

  JoinedWalls join() {
    make_joints();
    remove_duplicates(out_.duplicates);
    divide();
    remove_duplicates(out_.covered);
    if (walls_.size() > kMostWalls) {
      refuse(fmt::format("The drawing has {} walls. A network has at most {}.", walls_.size(), kMostWalls));
    }
    const Net net = net_of_walls();
    out_.loose = find_loose_ends(net);
    out_.islands = find_islands(net);
    write();
    return std::move(out_);
  }

 private:
  void scale(const Drawing& drawing) {
    const double mm = options_.mm_per_unit;
    shortest_ = std::numeric_limits<double>::infinity();
    for (const DrawnWall& wall : drawing.walls) {
      const double reach =
          mm * std::max({std::abs(wall.start.x), std::abs(wall.start.y), std::abs(wall.end.x), std::abs(wall.end.y)});
      const double length = mm * distance(wall.start, wall.end);
      if (!std::isfinite(reach + length)) refuse(fmt::format("{} has no finite place. Correct it.", wall.name));
      if (length <= options_.tolerance_mm.value_or(0.0)) {
        ++out_.without_length;
        continue;
      }
      if (!(std::abs(mm * wall.rise) <= length)) {
        refuse(fmt::format("{} is an arc that rises more than the length of its chord. Divide it.", wall.name));
      }
      shortest_ = std::min(shortest_, length);
      farthest_ = std::max(farthest_, reach);
      const auto thickness = wall.thickness ? std::optional(mm * *wall.thickness) : options_.thickness_mm;
      if (!thickness) refuse(fmt::format("{} has no thickness. Give that of such walls (--thickness).", wall.name));
      lines_.push_back({{mm * wall.start.x, mm * wall.start.y},
                        {mm * wall.end.x, mm * wall.end.y},
                        mm * wall.rise,
                        thickness,
                        wall.name});
    }
    if (lines_.empty()) refuse("No line has a length. Check the unit and the tolerance.");
  }

  void make_joints() {
    WallGrid grid(out_.tolerance_mm);
    const auto joint_at = [&](const DrawnPlace& place) {
      int joint = -1;
      grid.visit_near(place, [&](int other) {
        if (distance(joints_[other], place) <= out_.tolerance_mm && (joint < 0 || other < joint)) joint = other;
      });
      if (joint >= 0) return joint;
      joints_.push_back(place);
      grid.add(place, static_cast<int>(joints_.size()) - 1);
      return static_cast<int>(joints_.size()) - 1;
    };
    for (const DrawnWall& line : lines_) {
      const int start = joint_at(line.start);
      walls_.push_back({start, joint_at(line.end), line.rise, *line.thickness});
    }
    std::set<std::pair<double, double>> places;
    for (const DrawnWall& line : lines_) {
      places.insert({line.start.x, line.start.y});
      places.insert({line.end.x, line.end.y});
    }
    out_.merged = static_cast<int>(places.size()) - static_cast<int>(joints_.size());
  }

  /// Keeps the first of walls with the same joints and rise. Their middles are added to `found`.
  void remove_duplicates(std::vector<DrawnPlace>& found) {
    std::set<std::tuple<int, int, long>> seen;
    const auto is_again = [&](const Wall& wall) {
      if (wall.start == wall.end) {
        ++out_.without_length;
        return true;
      }
      const bool turned = wall.start > wall.end;
      const long rise = std::lround((turned ? -wall.rise : wall.rise) / out_.tolerance_mm);
      const auto ends = std::minmax(wall.start, wall.end);
      if (seen.emplace(ends.first, ends.second, rise).second) return false;
      found.push_back(curve_of(wall).place_at(0.5));
      return true;
    };
    std::erase_if(walls_, is_again);
  }

  [[nodiscard]] WallCurve curve_of(const Wall& wall) const {
    return {joints_[wall.start], joints_[wall.end], wall.rise};
  }

  /// Joints on walls, and their crossings, part these.
  void divide() {
    for (const Wall& wall : walls_) curves_.push_back(curve_of(wall));
    const std::vector<Cuts> cuts = find_cuts();
    std::vector<Wall> parts;
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      Wall part = walls_[i];
      double from = 0.0;
      const auto end_part = [&](double share, int joint) {
        part.end = joint;
        if (!cuts[i].empty()) part.rise = curves_[i].rise_between(from, share);
        parts.push_back(part);
        part.start = joint;
        from = share;
      };
      for (const auto& [share, joint] : cuts[i]) end_part(share, joint);
      end_part(1.0, walls_[i].end);
    }
    walls_ = std::move(parts);
  }

  std::vector<Cuts> find_cuts() {
    double all = 0.0;
    for (const WallCurve& curve : curves_) all += curve.length();
    WallGrid grid(2.0 * all / static_cast<double>(curves_.size()));
    for (std::size_t i = 0; i < curves_.size(); ++i) grid.add(curves_[i], out_.tolerance_mm, static_cast<int>(i));
    std::vector<Cuts> cuts(walls_.size());
    cut_at_joints(grid, cuts);
    cut_at_crossings(grid, cuts);
    return cuts;
  }

  void cut_at_joints(const WallGrid& grid, std::vector<Cuts>& cuts) {
    for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
      const std::vector<int>& near = grid.items_at(joints_[joint]);
      count_pairs(near.size());
      for (const int wall : near) {
        if (walls_[wall].start == static_cast<int>(joint) || walls_[wall].end == static_cast<int>(joint)) continue;
        const double share = curves_[wall].share_of(joints_[joint], out_.tolerance_mm);
        if (share < 0.0) continue;
        cuts[wall].emplace(share, static_cast<int>(joint));
        ++out_.divided;
      }
    }
  }

  struct Crossing {
    int one;
    int other;
    DrawnPlace place;
  };

  /// Each crossing once, in the order of the walls.
  std::vector<Crossing> find_crossings(const WallGrid& grid) {
    std::vector<Crossing> crossings;
    grid.visit_squares([&](const WallGrid::Square& square, const std::vector<int>& items) {
      count_pairs(items.size() * (items.size() - 1) / 2);
      for (std::size_t i = 0; i < items.size(); ++i) {
        for (std::size_t j = i + 1; j < items.size(); ++j) {
          const auto [one, other] = std::minmax(items[i], items[j]);
          for (const DrawnPlace& place : curves_[one].crossings_with(curves_[other], out_.tolerance_mm)) {
            if (grid.square_of(place) == square) crossings.push_back({one, other, place});
          }
          if (crossings.size() > kMostWalls) {
            refuse(fmt::format("More than {} walls cross. Join them at their crossings.", kMostWalls));
          }
        }
      }
    });
    std::ranges::sort(crossings, {}, [](const Crossing& crossing) {
      return std::tuple(crossing.one, crossing.other, crossing.place.x, crossing.place.y);
    });
    return crossings;
  }

  void cut_at_crossings(const WallGrid& grid, std::vector<Cuts>& cuts) {
    for (const auto& [one, other, place] : find_crossings(grid)) {
      int joint = cut_near(cuts[one], one, place);
      if (joint < 0) joint = cut_near(cuts[other], other, place);
      if (joint < 0) {
        out_.crossings.push_back(place);
        if (!options_.joins_crossings) continue;
        joint = static_cast<int>(joints_.size());
        joints_.push_back(place);
      }
      for (const int wall : {one, other}) {
        if (cut_near(cuts[wall], wall, place) >= 0) continue;
        cuts[wall].emplace(curves_[wall].share_of(place, out_.tolerance_mm), joint);
      }
    }
  }

  /// The joint of a cut at a place of a wall; -1 without one. Three walls through one place cross there once.
  [[nodiscard]] int cut_near(const Cuts& cuts, int wall, const DrawnPlace& place) const {
    const double share = curves_[wall].share_of(place, out_.tolerance_mm);
    const double room = 2.0 * out_.tolerance_mm / curves_[wall].length();
    for (auto cut = cuts.lower_bound({share - room, -1}); cut != cuts.end() && cut->first <= share + room; ++cut) {
      if (distance(joints_[cut->second], place) <= out_.tolerance_mm) return cut->second;
    }
    return -1;
  }

  void count_pairs(std::size_t count) {
    pairs_ += static_cast<long>(count);
    if (pairs_ <= kMostPairs) return;
    refuse("Too many lines of the drawing lie on top of each other or beside each other. Leave out what is no wall.");
  }

  [[nodiscard]] Net net_of_walls() const {
    Net net;
    net.joints = joints_;
    for (const Wall& wall : walls_) net.walls.emplace_back(wall.start, wall.end);
    return net;
  }

  void write() {
    std::vector<int> number(joints_.size(), -1);
    const auto joint_of = [&](int joint) {
      if (number[joint] < 0) {
        number[joint] = out_.network.joints_mm_size() / 2;
        out_.network.add_joints_mm(joints_[joint].x);
        out_.network.add_joints_mm(joints_[joint].y);
      }
      return number[joint];
    };
    const auto is_alike = [&](const Wall& wall) { return wall.thickness == walls_.front().thickness; };
    const bool is_even = std::ranges::all_of(walls_, is_alike);
    if (is_even) out_.network.set_wall_thickness_mm(walls_.front().thickness);
    const bool has_arcs = std::ranges::any_of(walls_, [](const Wall& wall) { return wall.rise != 0.0; });
    for (const Wall& wall : walls_) {
      out_.network.add_walls(joint_of(wall.start));
      out_.network.add_walls(joint_of(wall.end));
      if (!is_even) out_.network.add_thicknesses_mm(wall.thickness);
      if (has_arcs) out_.network.add_rises_mm(wall.rise);
    }
  }

  JoinOptions options_;
  double shortest_ = 0.0;
  double farthest_ = 0.0;
  std::vector<DrawnWall> lines_;  ///< in mm, bonded
  std::vector<DrawnPlace> joints_;
  std::vector<Wall> walls_;
  std::vector<WallCurve> curves_;  ///< of the walls before they are divided
  long pairs_ = 0;
  JoinedWalls out_;
};

}  // namespace

JoinedWalls join_walls(const Drawing& drawing, const JoinOptions& options) { return Joiner(drawing, options).join(); }

}  // namespace cellcrush::drawing
