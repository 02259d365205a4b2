#include "chart/chart.h"

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
const TextStyle kOvershootStyle{.size = 11.0};

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

// Draws a mark centred at (x, y). Disc and triangle are filled, square and diamond open, and the cross is two strokes,
// so that marks differ without colour.
void draw_marker(cairo_t* context, double x, double y, Marker marker, const Colour& colour) {
  cairo_set_dash(context, nullptr, 0, 0.0);
  cairo_set_line_width(context, 1.4);
  cairo_new_path(context);
  const bool is_open = marker == Marker::square || marker == Marker::diamond;
  switch (marker) {
    case Marker::none: return;
    case Marker::disc: cairo_arc(context, x, y, kMarkerRadius, 0.0, 2.0 * std::numbers::pi); break;
    case Marker::square: draw_polygon(context, x, y, {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}}); break;
    case Marker::triangle: draw_polygon(context, x, y, {{0.0, -1.15}, {1.1, 0.85}, {-1.1, 0.85}}); break;
    case Marker::diamond: draw_polygon(context, x, y, {{0.0, -1.25}, {1.25, 0.0}, {0.0, 1.25}, {-1.25, 0.0}}); break;
    case Marker::cross:
      set_colour(context, colour);
      for (const double slope : {1.0, -1.0}) {
        stroke(context, x - kMarkerRadius, y - slope * kMarkerRadius, x + kMarkerRadius, y + slope * kMarkerRadius);
      }
      return;
  }
  set_colour(context, is_open ? Colour{1.0, 1.0, 1.0} : colour);
  cairo_fill_preserve(context);
  set_colour(context, colour);
  is_open ? cairo_stroke(context) : cairo_new_path(context);
}

// Draws the arrow and text of a curve that leaves the chart; `room` units below the upper edge are occupied.
void draw_overshoot(cairo_t* context, const Axes& axes, const Overshoot& overshoot, double room) {
  const double x = axes.x(overshoot.x);
  const double y = axes.area().y + room + 8.0;
  draw_marker(context, x, y, Marker::triangle, overshoot.colour);
  const bool left = x > axes.area().x + 0.75 * axes.area().width;
  const double width = text_width(context, overshoot.text, kOvershootStyle) + 4.0;
  set_colour(context, {1.0, 1.0, 1.0, 0.85});
  cairo_rectangle(context, left ? x - width - 6.0 : x + 6.0, y - 7.0, width, 14.0);
  cairo_fill(context);
  draw_text(context, x + (left ? -8.0 : 8.0), y + 4.0, overshoot.text,
            {.size = 11.0, .colour = overshoot.colour, .anchor = left ? Anchor::right : Anchor::left});
}

// A label beside a point: on its right and above, or where that would reach the frame, on its left and below.
void draw_label(cairo_t* context, const Rectangle& area, double x, double y, const std::string& text) {
  constexpr double kFrame = 8.0;  // with its ticks
  TextStyle style = kLabelStyle;
  const double right = area.x + area.width - kFrame;
  const bool has_room = x + kLabelGap + text_width(context, text, style) < right;
  style.anchor = has_room ? Anchor::left : Anchor::right;
  const double baseline = y - 4.0 - style.size < area.y + kFrame ? y + 4.0 + style.size : y - 4.0;
  draw_text(context, has_room ? x + kLabelGap : x - kLabelGap, baseline, text, style);
}

// Draws bars, marks and labels at the points of a curve. Skips points that are not finite.
void draw_marks(cairo_t* context, const Axes& axes, const Curve& curve) {
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double x = axes.x(curve.x[i]);
    const double y = axes.y(curve.y[i]);
    if (!std::isfinite(x + y)) continue;
    set_colour(context, curve.style.colour);
    if (!curve.low.empty()) draw_bar(context, axes, x, curve.low[i], curve.high[i]);
    draw_marker(context, x, y, curve.marker, curve.style.colour);
    if (!curve.labels.empty()) draw_label(context, axes.area(), x, y, curve.labels[i]);
  }
}

constexpr Colour kBandColour{0.945, 0.935, 0.90};
constexpr double kLegendRow = 20.0;
constexpr double kNarrow = 500.0;
constexpr double kLegendLine = 15.0;
constexpr double kSwatch = 26.0;
constexpr double kLegendGap = 18.0;
constexpr double kNoteLine = 14.0;
const TextStyle kLegendStyle{.size = 12.0};
const TextStyle kNoteStyle{.size = 10.5, .colour = kMutedInk, .anchor = Anchor::right};

void apply(cairo_t* context, const LineStyle& style) {
  set_colour(context, style.colour);
  cairo_set_line_width(context, style.width);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(context, style.dashes.data(), static_cast<int>(style.dashes.size()), 0.0);
}

void draw_curve(cairo_t* context, const Axes& axes, const Curve& curve) {
  if (curve.style.width <= 0.0) return;
  apply(context, curve.style);
  bool begin = true;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const bool known = std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]);
    if (!known) {
      begin = true;
    } else if (begin) {
      cairo_move_to(context, axes.x(curve.x[i]), axes.y(curve.y[i]));
      begin = false;
    } else {
      cairo_line_to(context, axes.x(curve.x[i]), axes.y(curve.y[i]));
    }
  }
  cairo_stroke(context);
  cairo_set_dash(context, nullptr, 0, 0.0);
}

void draw_swatch(cairo_t* context, double x, double y, const Curve& curve) {
  if (curve.style.width > 0.0) {
    apply(context, curve.style);
    cairo_move_to(context, x, y);
    cairo_line_to(context, x + kSwatch, y);
    cairo_stroke(context);
    cairo_set_dash(context, nullptr, 0, 0.0);
  }
  draw_marker(context, x + 0.5 * kSwatch, y, curve.marker, curve.style.colour);
}

// Visits the legend's entries row by row and returns its height; draws them if `draw` is set. A long name has several
// rows.
double lay_legend(cairo_t* context, const Rectangle& place, const Chart& chart, bool draw) {
  double x = place.x;
  double y = place.y;
  for (const Curve& curve : chart.curves) {
    if (curve.name.empty()) continue;
    const auto lines = wrap_to_width(context, curve.name, place.width - kSwatch - 8.0, kLegendStyle);
    double width = 0.0;
    for (const std::string& line : lines) width = std::max(width, text_width(context, line, kLegendStyle));
    width += kSwatch + 8.0 + kLegendGap;
    if (x > place.x && (lines.size() > 1 || x + width - kLegendGap > place.x + place.width)) {
      x = place.x;
      y += kLegendRow;
    }
    if (draw) draw_swatch(context, x, y + 10.0, curve);
    for (std::size_t i = 0; draw && i < lines.size(); ++i) {
      draw_text(context, x + kSwatch + 8.0, y + 14.3 + kLegendLine * static_cast<double>(i), lines[i], kLegendStyle);
    }
    y += kLegendLine * static_cast<double>(lines.size() - 1);
    x += width;
  }
  return x > place.x || y > place.y ? y + kLegendRow - place.y : 0.0;
}

void draw_mark(cairo_t* context, const Axes& axes, const Mark& mark) {
  const double x = axes.x(mark.x);
  apply(context, {mark.colour, 1.2, {1.5, 3.0}});
  stroke(context, x, axes.area().y, x, axes.area().y + axes.area().height);
  cairo_set_dash(context, nullptr, 0, 0.0);
  const TextStyle style{.size = 10.5, .colour = mark.colour, .upwards = true};
  const bool has_room = x - axes.area().x > 16.0;
  draw_text(context, has_room ? x - 4.0 : x + 11.0, axes.area().y + 0.88 * axes.area().height, mark.text, style);
}

}  // namespace

Curve level_curve(double value, double from, double to, LineStyle style, std::string name) {
  Curve curve;
  curve.x = {from, to};
  curve.y = {value, value};
  curve.style = std::move(style);
  curve.name = std::move(name);
  return curve;
}

void scale_y(Chart& chart, double factor) {
  chart.y.low *= factor;
  chart.y.high *= factor;
  for (Curve& curve : chart.curves) {
    for (auto* values : {&curve.y, &curve.low, &curve.high}) {
      for (double& value : *values) value *= factor;
    }
  }
}

double note_height(cairo_t* context, double width, const std::string& note) {
  return 2.0 + kNoteLine * static_cast<double>(wrap_to_width(context, note, width, kNoteStyle).size());
}

void draw_note(cairo_t* context, double right, double y, double width, const std::string& note) {
  for (const std::string& line : wrap_to_width(context, note, width, kNoteStyle)) {
    draw_text(context, right, y, line, kNoteStyle);
    y += kNoteLine;
  }
}

void draw_chart(cairo_t* context, const Rectangle& place, const Chart& chart) {
  const Rectangle inner{place.x + Axes::kLeft, place.y, place.width - Axes::kLeft, 0.0};
  // A narrow chart has its legend above the labels of the axis, too.
  const Rectangle legend = place.width < kNarrow ? place : inner;
  const double legend_height = lay_legend(context, legend, chart, true);
  const double top = place.y + legend_height + 8.0;
  const double note_width = place.width - 8.0;
  const double bottom = place.y + place.height - Axes::kBelow - note_height(context, note_width, chart.note);
  const Axes axes({inner.x, top, inner.width - 8.0, bottom - top}, chart.x, chart.y);
  const Rectangle& area = axes.area();
  cairo_save(context);
  cairo_rectangle(context, area.x, area.y, area.width, area.height);
  cairo_clip(context);
  for (const Band& band : chart.bands) {
    set_colour(context, kBandColour);
    cairo_rectangle(context, axes.x(band.from), area.y, axes.x(band.to) - axes.x(band.from), area.height);
    cairo_fill(context);
  }
  for (const Mark& mark : chart.marks) draw_mark(context, axes, mark);
  for (const Curve& curve : chart.curves) draw_curve(context, axes, curve);
  for (const Curve& curve : chart.curves) draw_marks(context, axes, curve);
  for (const Band& band : chart.bands) {
    draw_text(context, 0.5 * (axes.x(band.from) + axes.x(band.to)), area.y + 16.0, band.text,
              {.size = 11.0, .colour = kMutedInk, .anchor = Anchor::middle});
  }
  constexpr double kBandText = 20.0;
  for (const Overshoot& overshoot : chart.overshoots) {
    const double width = text_width(context, overshoot.text, kOvershootStyle) + 16.0;
    const double reach = width / area.width * (chart.x.high - chart.x.low);
    const bool beside_band = std::any_of(chart.bands.begin(), chart.bands.end(), [&](const Band& band) {
      return overshoot.x + reach > band.from && overshoot.x - reach < band.to;
    });
    // Those of other curves nearby are stacked above.
    const auto above = std::count_if(chart.overshoots.data(), &overshoot,
                                     [&](const Overshoot& other) { return std::abs(other.x - overshoot.x) < reach; });
    draw_overshoot(context, axes, overshoot, (beside_band ? kBandText : 0.0) + 16.0 * static_cast<double>(above));
  }
  cairo_restore(context);
  axes.draw_frame(context);
  draw_note(context, area.x + area.width, area.y + area.height + Axes::kBelow + 10.0, note_width, chart.note);
}

}  // namespace cellcrush::client
