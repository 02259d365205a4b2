#include "drawing/bond_walls.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace cellcrush::drawing {
namespace {

/// Of a mean thickness: ends that lie at least so near to the mid-line of a foil are on it.
constexpr double kOnMidLine = 0.05;
/// Most pairs of walls that lie above each other, and of those that are near.
constexpr long kMostPassed = 1'000'000'000;
constexpr long kMostNear = 10'000'000;

/// Coordinates of a place from the start of a wall: along it, and to its left.
struct OnFoil {
  double x = 0.0;
  double y = 0.0;
};

/// The line of a wall.
struct FoilLine {
  DrawnPlace start;
  double cosine = 1.0;
  double sine = 0.0;
  double length = 0.0;

  explicit FoilLine(const DrawnWall& wall) : start(wall.start), length(distance(wall.start, wall.end)) {
    cosine = (wall.end.x - wall.start.x) / length;
    sine = (wall.end.y - wall.start.y) / length;
  }
  [[nodiscard]] OnFoil of(const DrawnPlace& place) const {
    const double x = place.x - start.x;
    const double y = place.y - start.y;
    return {x * cosine + y * sine, y * cosine - x * sine};
  }
  [[nodiscard]] DrawnPlace at(const OnFoil& place) const {
    return {start.x + place.x * cosine - place.y * sine, start.y + place.x * sine + place.y * cosine};
  }
};

/// Two walls face to face, by the axis of the first.
struct FacingFoils {
  std::size_t first = 0;
  std::size_t second = 0;
  FoilLine axis;
  double from = 0.0;  ///< of what faces, along the axis
  double to = 0.0;
  double low = 0.0;  ///< where places go with the bond: up to ends that end as one
  double high = 0.0;
  OnFoil other_from;  ///< the ends of the second wall, in the direction of the axis
  OnFoil other_to;
  double distance = 0.0;  ///< of the mid-lines, to the left
  double middle = 0.0;    ///< mid-line of both together
  double thickness = 0.0;
  double room = 0.0;  ///< within which an end is on a foil

  explicit FacingFoils(const FoilLine& of_first) : axis(of_first) {}

  /// The place on the bonded wall that a place on one of its foils goes to.
  [[nodiscard]] std::optional<DrawnPlace> moved(const DrawnPlace& place) const {
    const OnFoil along = axis.of(place);
    const bool is_on = std::abs(along.y) <= room || std::abs(along.y - distance) <= room;
    if (!is_on || along.x < low - room || along.x > high + room) return std::nullopt;
    return axis.at({std::clamp(along.x, from, to), middle});
  }
};

std::optional<FacingFoils> facing_of(const std::vector<DrawnWall>& walls, std::size_t first, std::size_t second,
                                     double share) {
  const DrawnWall& one = walls[first];
  const DrawnWall& other = walls[second];
  FacingFoils facing{FoilLine(one)};
  facing.first = first;
  facing.second = second;
  facing.other_from = facing.axis.of(other.start);
  facing.other_to = facing.axis.of(other.end);
  if (facing.other_from.x > facing.other_to.x) std::swap(facing.other_from, facing.other_to);
  const double thickness = 0.5 * (*one.thickness + *other.thickness);
  const auto is_apart = [&](double side) {
    const auto is_a_thickness = [&](const OnFoil& end) {
      return std::abs(side * end.y - thickness) <= share * thickness;
    };
    return is_a_thickness(facing.other_from) && is_a_thickness(facing.other_to);
  };
  if (!is_apart(1.0) && !is_apart(-1.0)) return std::nullopt;
  facing.low = facing.from = std::max(0.0, facing.other_from.x);
  facing.high = facing.to = std::min(facing.axis.length, facing.other_to.x);
  if (!(facing.to - facing.from > thickness)) return std::nullopt;
  if (std::abs(facing.other_from.x) < thickness) {
    facing.from = 0.5 * facing.other_from.x;
    facing.low = std::min(0.0, facing.other_from.x);
  }
  if (std::abs(facing.other_to.x - facing.axis.length) < thickness) {
    facing.to = 0.5 * (facing.other_to.x + facing.axis.length);
    facing.high = std::max(facing.axis.length, facing.other_to.x);
  }
  facing.distance = 0.5 * (facing.other_from.y + facing.other_to.y);
  const double outer = facing.distance > 0.0 ? 1.0 : -1.0;
  facing.middle = 0.5 * (facing.distance + outer * 0.5 * (*other.thickness - *one.thickness));
  facing.thickness = 2.0 * thickness;
  facing.room = std::max(kOnMidLine, share) * thickness;
  return facing;
}

/// Walls that lie face to face, each wall in one pair; in the order of the walls.
std::vector<FacingFoils> find_facing(const std::vector<DrawnWall>& walls, double share) {
  const auto low_x = [&](std::size_t i) { return std::min(walls[i].start.x, walls[i].end.x); };
  const auto high_x = [&](std::size_t i) { return std::max(walls[i].start.x, walls[i].end.x); };
  double thickest = 0.0;
  for (const DrawnWall& wall : walls) thickest = std::max(thickest, *wall.thickness);
  const double room = (1.0 + share) * thickest;
  std::vector<std::size_t> order(walls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, low_x);
  std::vector<std::pair<std::size_t, std::size_t>> near;
  long passed = 0;
  long beside = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const DrawnWall& one = walls[order[i]];
    if (one.rise != 0.0) continue;
    for (std::size_t j = i + 1; j < order.size() && low_x(order[j]) <= high_x(order[i]) + room; ++j) {
      const DrawnWall& other = walls[order[j]];
      const bool is_near = std::min(one.start.y, one.end.y) <= std::max(other.start.y, other.end.y) + room &&
                           std::min(other.start.y, other.end.y) <= std::max(one.start.y, one.end.y) + room;
      if (++passed > kMostPassed || (is_near && ++beside > kMostNear)) {
        refuse("Too many lines of the drawing lie side by side. Leave out what is no wall.");
      }
      if (other.rise == 0.0 && is_near && facing_of(walls, order[i], order[j], share)) {
        near.push_back(std::minmax(order[i], order[j]));
      }
    }
  }
  std::ranges::sort(near);
  std::vector<FacingFoils> all;
  std::vector<bool> used(walls.size(), false);
  for (const auto& [one, other] : near) {
    const auto facing = used[one] || used[other] ? std::nullopt : facing_of(walls, one, other, share);
    if (!facing) continue;
    used[one] = used[other] = true;
    all.push_back(*facing);
  }
  return all;
}

/// Moves the ends of walls that lay on the foils of a bond. `by_x`: all ends in the order of x.
void move_ends(const FacingFoils& bond, const std::vector<std::pair<double, DrawnPlace*>>& by_x) {
  const double room = bond.thickness;
  const DrawnPlace one = bond.axis.at({bond.low, bond.middle});
  const DrawnPlace other = bond.axis.at({bond.high, bond.middle});
  const auto [low, high] = std::minmax(one.x, other.x);
  auto at = std::ranges::lower_bound(by_x, low - room, {}, &std::pair<double, DrawnPlace*>::first);
  for (; at != by_x.end() && at->first <= high + room; ++at) {
    if (const auto moved = bond.moved(*at->second)) *at->second = *moved;
  }
}

/// The bonded wall, in place of the first; what remains of both is added.
void replace_walls(const FacingFoils& bond, const std::vector<DrawnWall>& given, std::vector<DrawnWall>& walls) {
  const DrawnPlace from = bond.axis.at({bond.from, bond.middle});
  const DrawnPlace to = bond.axis.at({bond.to, bond.middle});
  walls[bond.first] = {from, to, 0.0, bond.thickness, given[bond.first].name};
  const auto add_rest = [&](std::size_t wall, const OnFoil& start, const OnFoil& end) {
    const double thickness = *given[wall].thickness;
    if (start.x < bond.low) {
      walls.push_back({bond.axis.at(start), from, 0.0, thickness, given[wall].name});
    }
    if (end.x > bond.high) {
      walls.push_back({to, bond.axis.at(end), 0.0, thickness, given[wall].name});
    }
  };
  add_rest(bond.first, {0.0, 0.0}, {bond.axis.length, 0.0});
  add_rest(bond.second, bond.other_from, bond.other_to);
}

/// Bonds pairs of walls. Returns false if there are none.
bool bond_pairs(double share, std::vector<DrawnWall>& walls, std::vector<Bond>& bonds) {
  const std::vector<FacingFoils> pairs = find_facing(walls, share);
  if (pairs.empty()) return false;
  const std::vector<DrawnWall> given = walls;
  std::vector<bool> is_gone(walls.size(), false);
  for (const FacingFoils& pair : pairs) {
    replace_walls(pair, given, walls);
    is_gone[pair.second] = true;
    bonds.push_back({pair.axis.at({0.5 * (pair.from + pair.to), pair.middle}), pair.to - pair.from, pair.thickness});
  }
  std::vector<std::pair<double, DrawnPlace*>> by_x;
  for (DrawnWall& wall : walls) {
    by_x.emplace_back(wall.start.x, &wall.start);
    by_x.emplace_back(wall.end.x, &wall.end);
  }
  std::ranges::stable_sort(by_x, {}, &std::pair<double, DrawnPlace*>::first);
  for (const FacingFoils& pair : pairs) move_ends(pair, by_x);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (i >= is_gone.size() || !is_gone[i]) std::swap(walls[kept++], walls[i]);
  }
  walls.resize(kept);
  return true;
}

}  // namespace

std::vector<Bond> bond_walls(double share, std::vector<DrawnWall>& walls) {
  std::vector<Bond> bonds;
  while (share > 0.0 && bond_pairs(share, walls, bonds)) {
  }
  return bonds;
}

}  // namespace cellcrush::drawing
