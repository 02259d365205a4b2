#include "chart/axes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "chart/ticks.h"

namespace cellcrush::client {

namespace {

constexpr double kTickLength = 5.0;
constexpr double kUnitsPerTickAcross = 80.0;
constexpr double kUnitsPerTickUp = 42.0;
const TextStyle kTickStyle{.size = 12.0, .anchor = Anchor::middle};

struct Tick {
  double value = 0.0;
  std::string label;
};

std::vector<Tick> ticks_of(const Axis& axis, double length, double units_per_tick) {
  const int most = std::max(2, static_cast<int>(length / units_per_tick) + 1);
  const Ticks found =
      axis.logarithmic ? find_logarithmic_ticks(axis.low, axis.high, most) : find_ticks(axis.low, axis.high, most);
  std::vector<Tick> ticks;
  for (const double value : found.values) {
    ticks.push_back({value, axis.logarithmic ? logarithmic_tick_label(value) : tick_label(value, found.step)});
  }
  return ticks;
}

// Position of a value along an axis: 0 at its low end, 1 at its high end.
double share_of(const Axis& axis, double value) {
  if (axis.logarithmic) return std::log(value / axis.low) / std::log(axis.high / axis.low);
  return (value - axis.low) / (axis.high - axis.low);
}

void line(cairo_t* context, double x0, double y0, double x1, double y1) {
  cairo_move_to(context, x0, y0);
  cairo_line_to(context, x1, y1);
  cairo_stroke(context);
}

}  // namespace

Axes::Axes(const Rectangle& area, Axis x, Axis y) : area_(area), x_(std::move(x)), y_(std::move(y)) {}

double Axes::x(double value) const { return area_.x + area_.width * share_of(x_, value); }

double Axes::y(double value) const { return area_.y + area_.height * (1.0 - share_of(y_, value)); }

void Axes::draw_frame(cairo_t* context) const {
  const double bottom = area_.y + area_.height;
  cairo_set_line_width(context, 1.0);
  set_colour(context, kInk);
  cairo_rectangle(context, area_.x, area_.y, area_.width, area_.height);
  cairo_stroke(context);
  for (const auto& [value, label] : ticks_of(x_, area_.width, kUnitsPerTickAcross)) {
    set_colour(context, kInk);
    line(context, x(value), bottom, x(value), bottom - kTickLength);
    line(context, x(value), area_.y, x(value), area_.y + kTickLength);
    draw_text(context, x(value), bottom + 17.0, label, kTickStyle);
  }
  TextStyle right_aligned = kTickStyle;
  right_aligned.anchor = Anchor::right;
  for (const auto& [value, label] : ticks_of(y_, area_.height, kUnitsPerTickUp)) {
    set_colour(context, kInk);
    line(context, area_.x, y(value), area_.x + kTickLength, y(value));
    line(context, area_.x + area_.width, y(value), area_.x + area_.width - kTickLength, y(value));
    draw_text(context, area_.x - 7.0, y(value) + 4.3, label, right_aligned);
  }
  draw_text(context, area_.x + 0.5 * area_.width, bottom + 38.0, x_.label, {.size = 13.0, .anchor = Anchor::middle});
  draw_text(context, area_.x - 46.0, area_.y + 0.5 * area_.height, y_.label,
            {.size = 13.0, .anchor = Anchor::middle, .upwards = true});
}

}  // namespace cellcrush::client
