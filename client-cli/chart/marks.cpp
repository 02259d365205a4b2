#include "chart/marks.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>

namespace cellcrush::client {

namespace {

constexpr double kMarkerRadius = 4.2;
constexpr double kBarEnd = 3.0;  ///< half of the stroke that ends a bar
constexpr double kLabelGap = 7.0;
const TextStyle kLabelStyle{.size = 9.5, .colour = kMutedInk};

void stroke(cairo_t* context, double x0, double y0, double x1, double y1) {
  cairo_move_to(context, x0, y0);
  cairo_line_to(context, x1, y1);
  cairo_stroke(context);
}

// A closed polygon around (x, y), in units of the mark's radius.
void draw_polygon(cairo_t* context, double x, double y, std::initializer_list<std::pair<double, double>> corners) {
  for (const auto& [across, down] : corners)
    cairo_line_to(context, x + across * kMarkerRadius, y + down * kMarkerRadius);
  cairo_close_path(context);
}

// Values that a logarithmic axis cannot show end at the lower edge of the area.
void draw_bar(cairo_t* context, const Axes& axes, double x, double low, double high) {
  const double bottom = axes.area().y + axes.area().height;
  const double from = std::isfinite(axes.y(low)) ? std::min(axes.y(low), bottom) : bottom;
  const double to = axes.y(high);
  cairo_set_line_width(context, 1.0);
  stroke(context, x, from, x, to);
  stroke(context, x - kBarEnd, to, x + kBarEnd, to);
  if (from < bottom) stroke(context, x - kBarEnd, from, x + kBarEnd, from);
}

}  // namespace

void draw_marker(cairo_t* context, double x, double y, Marker marker, const Colour& colour) {
  cairo_set_dash(context, nullptr, 0, 0.0);
  cairo_set_line_width(context, 1.4);
  cairo_new_path(context);
  if (marker == Marker::disc) {
    cairo_arc(context, x, y, kMarkerRadius, 0.0, 2.0 * std::numbers::pi);
    set_colour(context, colour);
    cairo_fill(context);
  } else if (marker == Marker::square) {
    const double half = 0.9 * kMarkerRadius;
    cairo_rectangle(context, x - half, y - half, 2.0 * half, 2.0 * half);
    set_colour(context, {1.0, 1.0, 1.0});
    cairo_fill_preserve(context);
    set_colour(context, colour);
    cairo_stroke(context);
  } else if (marker == Marker::triangle) {
    draw_polygon(context, x, y, {{0.0, -1.15}, {1.1, 0.85}, {-1.1, 0.85}});
    set_colour(context, colour);
    cairo_fill(context);
  } else if (marker == Marker::diamond) {
    draw_polygon(context, x, y, {{0.0, -1.25}, {1.25, 0.0}, {0.0, 1.25}, {-1.25, 0.0}});
    set_colour(context, {1.0, 1.0, 1.0});
    cairo_fill_preserve(context);
    set_colour(context, colour);
    cairo_stroke(context);
  } else if (marker == Marker::cross) {
    set_colour(context, colour);
    for (const double slope : {1.0, -1.0}) {
      stroke(context, x - kMarkerRadius, y - slope * kMarkerRadius, x + kMarkerRadius, y + slope * kMarkerRadius);
    }
  }
}

void draw_overshoot(cairo_t* context, const Axes& axes, const Overshoot& overshoot, double room) {
  const double x = axes.x(overshoot.x);
  const double y = axes.area().y + room + 8.0;
  draw_marker(context, x, y, Marker::triangle, overshoot.colour);
  const bool left = x > axes.area().x + 0.75 * axes.area().width;
  const double width = text_width(context, overshoot.text, {.size = 11.0}) + 4.0;
  set_colour(context, {1.0, 1.0, 1.0, 0.85});
  cairo_rectangle(context, left ? x - width - 6.0 : x + 6.0, y - 7.0, width, 14.0);
  cairo_fill(context);
  draw_text(context, x + (left ? -8.0 : 8.0), y + 4.0, overshoot.text,
            {.size = 11.0, .colour = overshoot.colour, .anchor = left ? Anchor::right : Anchor::left});
}

void draw_marks(cairo_t* context, const Axes& axes, const Curve& curve) {
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double x = axes.x(curve.x[i]);
    const double y = axes.y(curve.y[i]);
    if (!std::isfinite(x + y)) continue;
    set_colour(context, curve.style.colour);
    if (!curve.low.empty()) draw_bar(context, axes, x, curve.low[i], curve.high[i]);
    draw_marker(context, x, y, curve.marker, curve.style.colour);
    if (!curve.labels.empty()) draw_text(context, x + kLabelGap, y - 4.0, curve.labels[i], kLabelStyle);
  }
}

}  // namespace cellcrush::client
