#include "drawing/join_walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "command_error.h"

namespace cellcrush::client {
namespace {

/// A wall in mm with the joints that its ends have become.
struct Wall {
  int start = 0;
  int end = 0;
  double rise = 0.0;
  double thickness = 0.0;
};

/// Finds what lies near a place, by squares of a size.
class Grid {
 public:
  explicit Grid(double size) : size_(size) {}

  void add(const DrawnPlace& place, int item) { cells_[key(column(place.x), column(place.y))].push_back(item); }

  /// Adds to every square that a box touches.
  void add(const DrawnPlace& low, const DrawnPlace& high, int item) {
    for (long x = column(low.x); x <= column(high.x); ++x) {
      for (long y = column(low.y); y <= column(high.y); ++y) cells_[key(x, y)].push_back(item);
    }
  }

  /// Calls visit(item) for the items of the square of a place and of those around it.
  template <class Visit>
  void visit_near(const DrawnPlace& place, const Visit& visit) const {
    for (long x = column(place.x) - 1; x <= column(place.x) + 1; ++x) {
      for (long y = column(place.y) - 1; y <= column(place.y) + 1; ++y) {
        const auto found = cells_.find(key(x, y));
        if (found == cells_.end()) continue;
        for (const int item : found->second) visit(item);
      }
    }
  }

  /// Calls visit(items) for every square.
  template <class Visit>
  void visit_squares(const Visit& visit) const {
    for (const auto& [cell, items] : cells_) visit(items);
  }

 private:
  [[nodiscard]] long column(double value) const { return static_cast<long>(std::floor(value / size_)); }
  static std::uint64_t key(long x, long y) {
    return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(y);
  }
  double size_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

class Joiner {
 public:
  Joiner(const Drawing& drawing, const JoinOptions& options) : options_(options) {
    scale(drawing);
    out_.bonds = bond_walls(options.bond, lines_);
    out_.tolerance_mm = options.tolerance_mm.value_or(kTolerance * shortest_);
    if (!(out_.tolerance_mm > 0.0)) refuse("The tolerance is 0 mm. Give a positive one with --tolerance.");
  }

  JoinedWalls join() {
    make_joints();
    remove_duplicates();
    divide();
    remove_duplicates();
    find_loose_ends();
    find_islands();
    write();
    return std::move(out_);
  }

 private:
  void scale(const Drawing& drawing) {
    const double mm = options_.mm_per_unit;
    shortest_ = std::numeric_limits<double>::infinity();
    for (const DrawnWall& wall : drawing.walls) {
      const double length = mm * distance(wall.start, wall.end);
      if (length <= options_.tolerance_mm.value_or(0.0)) {
        out_.lengths.push_back(wall.name);
        continue;
      }
      shortest_ = std::min(shortest_, length);
      const auto thickness = wall.thickness ? std::optional(mm * *wall.thickness) : options_.thickness_mm;
      if (!thickness) refuse(fmt::format("{} has no thickness. Give that of such walls with --thickness.", wall.name));
      lines_.push_back({{mm * wall.start.x, mm * wall.start.y},
                        {mm * wall.end.x, mm * wall.end.y},
                        mm * wall.rise,
                        thickness,
                        wall.name});
    }
    if (lines_.empty()) refuse("No line has a length. Check the unit and the tolerance.");
  }

  void make_joints() {
    Grid grid(out_.tolerance_mm);
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

  void remove_duplicates() {
    std::set<std::tuple<int, int, long>> seen;
    const auto is_again = [&](const Wall& wall) {
      if (wall.start == wall.end) return true;
      const bool turned = wall.start > wall.end;
      const long rise = std::lround((turned ? -wall.rise : wall.rise) / out_.tolerance_mm);
      return !seen.emplace(std::min(wall.start, wall.end), std::max(wall.start, wall.end), rise).second;
    };
    out_.duplicates += static_cast<int>(std::erase_if(walls_, is_again));
  }

  /// Where on a straight wall a place lies, as a share of it; less than 0 where it is not on it.
  [[nodiscard]] double share_on(const Wall& wall, const DrawnPlace& place) const {
    const DrawnPlace& from = joints_[wall.start];
    const DrawnPlace& to = joints_[wall.end];
    const double length = distance(from, to);
    const double along = ((place.x - from.x) * (to.x - from.x) + (place.y - from.y) * (to.y - from.y)) / length;
    const double across = ((place.x - from.x) * (to.y - from.y) - (place.y - from.y) * (to.x - from.x)) / length;
    const bool is_on =
        std::abs(across) <= out_.tolerance_mm && along > out_.tolerance_mm && along < length - out_.tolerance_mm;
    return is_on ? along / length : -1.0;
  }

  /// Where two straight walls cross between their ends.
  [[nodiscard]] std::optional<DrawnPlace> crossing_of(const Wall& one, const Wall& other) const {
    const DrawnPlace& a = joints_[one.start];
    const DrawnPlace& c = joints_[other.start];
    const DrawnPlace u = {joints_[one.end].x - a.x, joints_[one.end].y - a.y};
    const DrawnPlace v = {joints_[other.end].x - c.x, joints_[other.end].y - c.y};
    const double turn = u.x * v.y - u.y * v.x;
    if (turn == 0.0) return std::nullopt;
    const DrawnPlace w = {c.x - a.x, c.y - a.y};
    const double s = (w.x * v.y - w.y * v.x) / turn;
    const DrawnPlace place = {a.x + s * u.x, a.y + s * u.y};
    if (share_on(one, place) < 0.0 || share_on(other, place) < 0.0) return std::nullopt;
    return place;
  }

  /// Joints on straight walls, and their crossings, part these.
  void divide() {
    const std::vector<std::set<std::pair<double, int>>> cuts = find_cuts();
    std::vector<Wall> parts;
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      Wall part = walls_[i];
      for (const auto& [share, joint] : cuts[i]) {
        part.end = joint;
        parts.push_back(part);
        part.start = joint;
      }
      part.end = walls_[i].end;
      parts.push_back(part);
    }
    walls_ = std::move(parts);
  }

  std::vector<std::set<std::pair<double, int>>> find_cuts() {
    double longest = 0.0;
    for (const Wall& wall : walls_) longest += distance(joints_[wall.start], joints_[wall.end]);
    Grid grid(longest / static_cast<double>(walls_.size()));
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      if (walls_[i].rise != 0.0) continue;
      const DrawnPlace& from = joints_[walls_[i].start];
      const DrawnPlace& to = joints_[walls_[i].end];
      const double room = out_.tolerance_mm;
      grid.add({std::min(from.x, to.x) - room, std::min(from.y, to.y) - room},
               {std::max(from.x, to.x) + room, std::max(from.y, to.y) + room}, static_cast<int>(i));
    }
    std::vector<std::set<std::pair<double, int>>> cuts(walls_.size());
    cut_at_joints(grid, cuts);
    cut_at_crossings(grid, cuts);
    return cuts;
  }

  void cut_at_joints(const Grid& grid, std::vector<std::set<std::pair<double, int>>>& cuts) {
    for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
      std::set<int> near;
      grid.visit_near(joints_[joint], [&](int wall) { near.insert(wall); });
      for (const int wall : near) {
        const double share = share_on(walls_[wall], joints_[joint]);
        if (share < 0.0 || walls_[wall].start == static_cast<int>(joint) || walls_[wall].end == static_cast<int>(joint))
          continue;
        cuts[wall].emplace(share, static_cast<int>(joint));
        ++out_.divided;
      }
    }
  }

  void cut_at_crossings(const Grid& grid, std::vector<std::set<std::pair<double, int>>>& cuts) {
    std::set<std::pair<int, int>> pairs;
    grid.visit_squares([&](const std::vector<int>& items) {
      for (std::size_t i = 0; i < items.size(); ++i) {
        for (std::size_t j = i + 1; j < items.size(); ++j) pairs.insert(std::minmax(items[i], items[j]));
      }
    });
    for (const auto& [one, other] : pairs) {
      const auto crossing = one == other ? std::nullopt : crossing_of(walls_[one], walls_[other]);
      if (!crossing) continue;
      int joint = cut_near(cuts[one], *crossing);
      if (joint < 0) joint = cut_near(cuts[other], *crossing);
      if (joint < 0) {
        out_.crossings.push_back(*crossing);
        if (!options_.joins_crossings) continue;
        joint = static_cast<int>(joints_.size());
        joints_.push_back(*crossing);
      }
      for (const int wall : {one, other}) {
        if (cut_near(cuts[wall], *crossing) < 0) cuts[wall].emplace(share_on(walls_[wall], joints_[joint]), joint);
      }
    }
  }

  /// The joint of a cut at a place; -1 without one. Three walls through one place cross there once.
  [[nodiscard]] int cut_near(const std::set<std::pair<double, int>>& cuts, const DrawnPlace& place) const {
    const auto found = std::ranges::find_if(
        cuts, [&](const auto& cut) { return distance(joints_[cut.second], place) <= out_.tolerance_mm; });
    return found == cuts.end() ? -1 : found->second;
  }

  void find_loose_ends() {
    std::vector<int> walls(joints_.size(), 0);
    for (const Wall& wall : walls_) {
      ++walls[wall.start];
      ++walls[wall.end];
    }
    for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
      if (walls[joint] == 1) out_.loose.push_back(joints_[joint]);
    }
  }

  void find_islands() {
    std::vector<int> parent(joints_.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root_of = [&](int joint) {
      while (parent[joint] != joint) joint = parent[joint] = parent[parent[joint]];
      return joint;
    };
    for (const Wall& wall : walls_) {
      const int one = root_of(wall.start);
      const int other = root_of(wall.end);
      parent[std::max(one, other)] = std::min(one, other);
    }
    std::map<int, int> walls;
    for (const Wall& wall : walls_) ++walls[root_of(wall.start)];
    const auto largest = std::ranges::max_element(walls, {}, [](const auto& part) { return part.second; });
    for (const auto& [root, count] : walls) {
      if (root == largest->first) continue;
      out_.islands.push_back(joints_[root]);
      out_.island_walls.push_back(count);
    }
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
  std::vector<DrawnWall> lines_;  // in mm
  std::vector<DrawnPlace> joints_;
  std::vector<Wall> walls_;
  JoinedWalls out_;
};

}  // namespace

JoinedWalls join_walls(const Drawing& drawing, const JoinOptions& options) { return Joiner(drawing, options).join(); }

}  // namespace cellcrush::client
