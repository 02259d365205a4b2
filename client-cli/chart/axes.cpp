#include "chart/axes.h"

#include <utility>

#include "chart/ticks.h"

namespace cellcrush::client {

namespace {

constexpr double kTickLength = 5.0;
constexpr double kUnitsPerTickAcross = 80.0;
constexpr double kUnitsPerTickUp = 42.0;
const TextStyle kTickStyle{.size = 12.0, .anchor = Anchor::middle};

Ticks ticks_of(const Axis& axis, double length, double units_per_tick) {
  return find_ticks(axis.low, axis.high, std::max(2, static_cast<int>(length / units_per_tick) + 1));
}

void line(cairo_t* context, double x0, double y0, double x1, double y1) {
  cairo_move_to(context, x0, y0);
  cairo_line_to(context, x1, y1);
  cairo_stroke(context);
}

}  // namespace

Axes::Axes(const Rectangle& area, Axis x, Axis y) : area_(area), x_(std::move(x)), y_(std::move(y)) {}

double Axes::x(double value) const { return area_.x + area_.width * (value - x_.low) / (x_.high - x_.low); }

double Axes::y(double value) const { return area_.y + area_.height * (1.0 - (value - y_.low) / (y_.high - y_.low)); }

void Axes::draw_frame(cairo_t* context) const {
  const double bottom = area_.y + area_.height;
  cairo_set_line_width(context, 1.0);
  set_colour(context, kInk);
  cairo_rectangle(context, area_.x, area_.y, area_.width, area_.height);
  cairo_stroke(context);
  const Ticks across = ticks_of(x_, area_.width, kUnitsPerTickAcross);
  for (const double tick : across.values) {
    set_colour(context, kInk);
    line(context, x(tick), bottom, x(tick), bottom - kTickLength);
    line(context, x(tick), area_.y, x(tick), area_.y + kTickLength);
    draw_text(context, x(tick), bottom + 17.0, tick_label(tick, across.step), kTickStyle);
  }
  const Ticks up = ticks_of(y_, area_.height, kUnitsPerTickUp);
  TextStyle right_aligned = kTickStyle;
  right_aligned.anchor = Anchor::right;
  for (const double tick : up.values) {
    set_colour(context, kInk);
    line(context, area_.x, y(tick), area_.x + kTickLength, y(tick));
    line(context, area_.x + area_.width, y(tick), area_.x + area_.width - kTickLength, y(tick));
    draw_text(context, area_.x - 7.0, y(tick) + 4.3, tick_label(tick, up.step), right_aligned);
  }
  draw_text(context, area_.x + 0.5 * area_.width, bottom + 38.0, x_.label, {.size = 13.0, .anchor = Anchor::middle});
  draw_text(context, area_.x - 46.0, area_.y + 0.5 * area_.height, y_.label,
            {.size = 13.0, .anchor = Anchor::middle, .upwards = true});
}

}  // namespace cellcrush::client
