#include "lattice/grade_walls.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cellcrush {
namespace {

int axis_of(const Grading& grading) { return grading.axis == Grading::Axis::x ? 0 : 1; }

double share_of(const Vector2& place, int axis, const Box& box) {
  return (place[axis] - box.low[axis]) / (box.high[axis] - box.low[axis]);
}

}  // namespace

double Factors::at(double share) const {
  const double inside = std::clamp(share, 0.0, 1.0);
  if (!steps_->empty()) {
    const auto count = static_cast<double>(steps_->size());
    return (*steps_)[static_cast<std::size_t>(std::min(std::floor(inside * count), count - 1.0))];
  }
  double value = 0.0;
  for (auto coefficient = polynomial_->rbegin(); coefficient != polynomial_->rend(); ++coefficient) {
    value = value * inside + *coefficient;
  }
  return value;
}

double Factors::up_to(double share) const {
  const double inside = std::clamp(share, 0.0, 1.0);
  double sum = (share - inside) * at(share);
  if (!steps_->empty()) {
    const double width = 1.0 / static_cast<double>(steps_->size());
    for (std::size_t i = 0; i < steps_->size(); ++i) {
      sum += (*steps_)[i] * std::clamp(inside - static_cast<double>(i) * width, 0.0, width);
    }
    return sum;
  }
  double power = inside;
  for (std::size_t i = 0; i < polynomial_->size(); ++i) {
    sum += (*polynomial_)[i] * power / static_cast<double>(i + 1);
    power *= inside;
  }
  return sum;
}

void grade_sizes(const Grading& grading, const Box& box, Layout& layout) {
  const Factors factors = size_factors(grading);
  if (!factors.are_given()) return;
  const int axis = axis_of(grading);
  const double extent = box.high[axis] - box.low[axis];
  std::vector<double> chords;
  std::ranges::transform(layout.walls, std::back_inserter(chords),
                         [&](const LayoutWall& wall) { return layout.chord_of(wall); });
  for (Vector2& joint : layout.joints) {
    joint[axis] = box.low[axis] + extent * factors.up_to(share_of(joint, axis, box)) / factors.up_to(1.0);
  }
  for (std::size_t w = 0; w < layout.walls.size(); ++w) {
    layout.walls[w].rise *= layout.chord_of(layout.walls[w]) / chords[w];
  }
}

void grade_thicknesses(const Grading& grading, const Box& box, Layout& layout) {
  const Factors factors = thickness_factors(grading);
  if (!factors.are_given()) return;
  double given = 0.0;
  double graded = 0.0;
  for (LayoutWall& wall : layout.walls) {
    const Vector2 middle = 0.5 * (layout.joints[wall.start] + layout.joints[wall.end]);
    const double length = layout.chord_of(wall);
    given += length * wall.thickness;
    wall.thickness *= factors.at(share_of(middle, axis_of(grading), box));
    graded += length * wall.thickness;
  }
  for (LayoutWall& wall : layout.walls) wall.thickness *= given / graded;
}

}  // namespace cellcrush
