#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "drawing/wall_geometry.h"

namespace cellcrush::drawing {

/// Finds what lies near a place, by squares of a size. REQUIRES: places within 1e15 sizes of the origin.
class WallGrid {
 public:
  struct Square {
    long x = 0;
    long y = 0;
    bool operator==(const Square&) const = default;
  };

  explicit WallGrid(double size) : size_(size) {}

  [[nodiscard]] Square square_of(const DrawnPlace& place) const { return {column(place.x), column(place.y)}; }

  void add(const DrawnPlace& place, int item) { squares_[square_of(place)].push_back(item); }

  /// Adds to every square through which a wall passes, and to those within `room` of it.
  void add(const WallCurve& wall, double room, int item) {
    const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * wall.length() / size_)));
    const double reach = 0.25 * size_ + room;  // from a place to the middle between it and the next one
    for (int i = 0; i <= steps; ++i) {
      const DrawnPlace place = wall.place_at(static_cast<double>(i) / steps);
      for (long x = column(place.x - reach); x <= column(place.x + reach); ++x) {
        for (long y = column(place.y - reach); y <= column(place.y + reach); ++y) {
          auto& items = squares_[{x, y}];
          if (items.empty() || items.back() != item) items.push_back(item);
        }
      }
    }
  }

  /// The items of the square of a place.
  [[nodiscard]] const std::vector<int>& items_at(const DrawnPlace& place) const {
    static const std::vector<int> kNone;
    const auto found = squares_.find(square_of(place));
    return found == squares_.end() ? kNone : found->second;
  }

  /// Calls visit(item) for the items of the square of a place and of those around it.
  template <class Visit>
  void visit_near(const DrawnPlace& place, const Visit& visit) const {
    const Square middle = square_of(place);
    for (long x = middle.x - 1; x <= middle.x + 1; ++x) {
      for (long y = middle.y - 1; y <= middle.y + 1; ++y) {
        const auto found = squares_.find({x, y});
        if (found == squares_.end()) continue;
        for (const int item : found->second) visit(item);
      }
    }
  }

  /// Calls visit(square, items) for every square.
  template <class Visit>
  void visit_squares(const Visit& visit) const {
    for (const auto& [square, items] : squares_) visit(square, items);
  }

 private:
  [[nodiscard]] long column(double value) const { return static_cast<long>(std::floor(value / size_)); }
  struct Hash {
    std::size_t operator()(const Square& square) const {
      return static_cast<std::uint64_t>(square.x) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(square.y);
    }
  };
  double size_;
  std::unordered_map<Square, std::vector<int>, Hash> squares_;
};

}  // namespace cellcrush::drawing
