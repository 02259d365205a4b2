#include "bench/label_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace cellcrush::bench {
namespace {

using client::Rectangle;

constexpr double kMarkRadius = 6.0;
constexpr std::array kGaps = {2.0, 9.0, 18.0, 29.0, 42.0, 57.0, 74.0};  ///< from the mark's edge to the label
constexpr int kDirections = 24;
constexpr double kLineCost = 6.0;  ///< a covered line is as bad as so much more distance
constexpr double kSideCost = 2.0;  ///< labels stand to the right above all

bool lies_in(const Rectangle& inner, const Rectangle& outer) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

bool is_free(const Rectangle& place, const std::vector<Rectangle>& taken) {
  return std::none_of(taken.begin(), taken.end(), [&](const Rectangle& other) { return overlap(place, other); });
}

Rectangle place_at(const MarkLabel& label, double gap, double angle) {
  const double across = std::cos(angle);
  const double up = std::sin(angle);
  const double middle_x = label.x + across * (kMarkRadius + gap + 0.5 * label.width);
  const double middle_y = label.y - up * (kMarkRadius + gap + 0.5 * label.height);
  return {middle_x - 0.5 * label.width, middle_y - 0.5 * label.height, label.width, label.height};
}

}  // namespace

bool overlap(const Rectangle& one, const Rectangle& other) {
  return one.x < other.x + other.width && other.x < one.x + one.width && one.y < other.y + other.height &&
         other.y < one.y + one.height;
}

std::vector<std::optional<Rectangle>> place_labels(const std::vector<MarkLabel>& labels, const Drawn& drawn,
                                                   const Rectangle& area) {
  std::vector<Rectangle> taken = drawn.marks;
  std::vector<std::optional<Rectangle>> places;
  for (const MarkLabel& label : labels) {
    double least = std::numeric_limits<double>::infinity();
    std::optional<Rectangle> best;
    for (const double gap : kGaps) {
      for (int direction = 0; direction < kDirections; ++direction) {
        const double angle = 2.0 * std::numbers::pi * direction / kDirections;
        const Rectangle place = place_at(label, gap, angle);
        if (!lies_in(place, area) || !is_free(place, taken)) continue;
        const auto covered = std::count_if(drawn.lines.begin(), drawn.lines.end(),
                                           [&](const Rectangle& line) { return overlap(place, line); });
        const double cost = gap + kSideCost * (1.0 - std::cos(angle)) + kLineCost * static_cast<double>(covered);
        if (cost < least) {
          least = cost;
          best = place;
        }
      }
    }
    if (best) taken.push_back(*best);
    places.push_back(best);
  }
  return places;
}

}  // namespace cellcrush::bench
