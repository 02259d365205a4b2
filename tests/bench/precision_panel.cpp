#include "bench/precision_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "bench/label_places.h"
#include "bench/precision_mark.h"

namespace cellcrush::bench {
namespace {

using client::Axes;
using client::Rectangle;

constexpr double kTitleHeight = 24.0;
constexpr double kLabelHeight = 13.0;
constexpr double kLegendRow = 21.0;
constexpr double kBarEnd = 3.0;
constexpr double kLeaderFrom = 5.0;  ///< a label farther than this from its mark's edge is tied to it by a line
constexpr client::Colour kFrontColour{0.86, 0.86, 0.87};
constexpr client::Colour kUnknownColour{0.945, 0.945, 0.93};
constexpr double kLabelSize = 11.5;
constexpr double kErrorLabelLeft = 54.0;  ///< of the axis, beyond its widest numbers

void stroke(cairo_t* context, double x0, double y0, double x1, double y1) {
  cairo_move_to(context, x0, y0);
  cairo_line_to(context, x1, y1);
  cairo_stroke(context);
}

/// Small squares along a straight line, for what must not hide it.
void add_line(std::vector<Rectangle>& lines, double x0, double y0, double x1, double y1) {
  const int parts = std::max(1, static_cast<int>(std::hypot(x1 - x0, y1 - y0) / 4.0));
  for (int i = 0; i <= parts; ++i) {
    const double share = static_cast<double>(i) / parts;
    lines.push_back({x0 + share * (x1 - x0) - 1.0, y0 + share * (y1 - y0) - 1.0, 2.0, 2.0});
  }
}

std::vector<PrecisionPoint> front_of(const std::vector<PrecisionSeries>& all) {
  std::vector<PrecisionPoint> front;
  for (const PrecisionSeries& series : all) {
    std::copy_if(series.points.begin(), series.points.end(), std::back_inserter(front),
                 [](const PrecisionPoint& point) { return point.on_front; });
  }
  std::sort(front.begin(), front.end(),
            [](const PrecisionPoint& one, const PrecisionPoint& other) { return one.seconds < other.seconds; });
  return front;
}

void draw_polyline(cairo_t* context, const Axes& axes, const std::vector<PrecisionPoint>& points, double width) {
  cairo_set_line_width(context, width);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  for (const PrecisionPoint& point : points) cairo_line_to(context, axes.x(point.seconds), axes.y(point.error));
  cairo_stroke(context);
}

/// An interval that holds no error at all goes down to the axis.
void draw_bar(cairo_t* context, const Axes& axes, const PrecisionPoint& point, Drawn& drawn) {
  const double x = axes.x(point.seconds);
  const double bottom = axes.area().y + axes.area().height;
  const double low = point.low > 0.0 ? std::min(axes.y(point.low), bottom) : bottom;
  const double high = axes.y(point.high);
  cairo_set_line_width(context, 1.1);
  stroke(context, x, low, x, high);
  stroke(context, x - kBarEnd, high, x + kBarEnd, high);
  if (low < bottom) stroke(context, x - kBarEnd, low, x + kBarEnd, low);
  add_line(drawn.lines, x, low, x, high);
}

void draw_unknown(cairo_t* context, const Axes& axes, double known_to) {
  const Rectangle& area = axes.area();
  const double top = std::max(axes.y(known_to), area.y);
  client::set_colour(context, kUnknownColour);
  cairo_rectangle(context, area.x, top, area.width, area.y + area.height - top);
  cairo_fill(context);
}

/// At the area's lower side, from the right, where no bar stands if there is such a place.
void name_unknown(cairo_t* context, const Rectangle& area, double known_to, Drawn& drawn) {
  std::array<char, 80> words{};
  std::snprintf(words.data(), words.size(), "reference: ±%.2g %%", known_to);
  const double width = client::text_width(context, words.data(), {.size = kLabelSize}) + 8.0;
  Rectangle place{area.x + 4.0, area.y + area.height - 20.0, width, 16.0};
  for (double x = area.x + area.width - width - 4.0; x > area.x; x -= 2.0) {
    const Rectangle trial{x, place.y, place.width, place.height};
    if (std::any_of(drawn.lines.begin(), drawn.lines.end(),
                    [&](const Rectangle& line) { return overlap(line, trial); })) {
      continue;
    }
    place = trial;
    break;
  }
  client::draw_text(context, place.x + 4.0, place.y + 12.0, words.data(),
                    {.size = kLabelSize, .colour = client::kMutedInk});
  drawn.marks.push_back(place);
}

void draw_series(cairo_t* context, const Axes& axes, const PrecisionSeries& series, Drawn& drawn) {
  const client::Colour colour = colour_of(series.family);
  client::set_colour(context, colour);
  if (series.family != Family::other_setting) {
    draw_polyline(context, axes, series.points, 1.3);
    for (std::size_t i = 1; i < series.points.size(); ++i) {
      const PrecisionPoint& from = series.points[i - 1];
      const PrecisionPoint& to = series.points[i];
      add_line(drawn.lines, axes.x(from.seconds), axes.y(from.error), axes.x(to.seconds), axes.y(to.error));
    }
  }
  for (const PrecisionPoint& point : series.points) {
    client::set_colour(context, colour);
    draw_bar(context, axes, point, drawn);
  }
  for (const PrecisionPoint& point : series.points) {
    const double x = axes.x(point.seconds);
    const double y = axes.y(point.error);
    draw_precision_mark(context, x, y, series.family, point.is_bound);
    drawn.marks.push_back({x - 5.0, y - 5.0, 10.0, 10.0});
  }
}

struct Text {
  MarkLabel label;
  std::string words;
  client::Colour colour;
};

void draw_label(cairo_t* context, const Text& text, const Rectangle& place) {
  const double x = std::clamp(text.label.x, place.x, place.x + place.width);
  const double y = std::clamp(text.label.y, place.y + 2.0, place.y + place.height - 2.0);
  const double distance = std::hypot(x - text.label.x, y - text.label.y);
  if (distance > 6.0 + kLeaderFrom) {
    cairo_set_line_width(context, 0.7);
    client::set_colour(context, {text.colour.red, text.colour.green, text.colour.blue, 0.7});
    const double start = 6.0 / distance;
    stroke(context, text.label.x + start * (x - text.label.x), text.label.y + start * (y - text.label.y), x, y);
  }
  client::draw_text(context, place.x + 1.0, place.y + place.height - 3.0, text.words,
                    {.size = kLabelSize, .colour = text.colour});
}

void draw_labels(cairo_t* context, const Axes& axes, const PrecisionPanel& panel, const Drawn& drawn) {
  std::vector<Text> texts;
  for (const PrecisionSeries& series : panel.series) {
    if (series.family == Family::other_setting && !panel.labels_settings) continue;
    for (const PrecisionPoint& point : series.points) {
      const double width = client::text_width(context, point.label, {.size = kLabelSize}) + 4.0;
      texts.push_back({{axes.x(point.seconds), axes.y(point.error), width, kLabelHeight},
                       point.label,
                       text_colour_of(series.family)});
    }
  }
  std::vector<MarkLabel> labels;
  labels.reserve(texts.size());
  for (const Text& text : texts) labels.push_back(text.label);
  const Rectangle& area = axes.area();
  const auto places = place_labels(labels, drawn, {area.x + 3.0, area.y + 3.0, area.width - 6.0, area.height - 6.0});
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (places[i]) draw_label(context, texts[i], *places[i]);
  }
}

}  // namespace

void fit_axes(PrecisionPanel& panel) {
  panel.x = {1e9, 0.0, "seconds of one core for a crush", true};
  panel.y = {1e9, 0.0, "", true};
  for (const PrecisionSeries& series : panel.series) {
    for (const PrecisionPoint& point : series.points) {
      panel.x.low = std::min(panel.x.low, 0.7 * point.seconds);
      panel.x.high = std::max(panel.x.high, 1.6 * point.seconds);
      panel.y.low = std::min(panel.y.low, 0.45 * point.error);
      panel.y.high = std::max(panel.y.high, 1.5 * point.high);
    }
  }
}

void draw_panel(cairo_t* context, const Rectangle& place, const PrecisionPanel& panel) {
  const double top = place.y + (panel.title.empty() ? 4.0 : kTitleHeight);
  const Axes axes(
      {place.x + Axes::kLeft, top, place.width - Axes::kLeft - 8.0, place.y + place.height - top - Axes::kBelow},
      panel.x, panel.y);
  const Rectangle& area = axes.area();
  client::draw_text(context, area.x, place.y + 14.0, panel.title, {.size = 14.0, .bold = true});
  Drawn drawn;
  cairo_save(context);
  cairo_rectangle(context, area.x, area.y, area.width, area.height);
  cairo_clip(context);
  if (panel.known_to > 0.0) draw_unknown(context, axes, panel.known_to);
  if (panel.shows_front) {
    client::set_colour(context, kFrontColour);
    draw_polyline(context, axes, front_of(panel.series), 6.0);
  }
  std::for_each(panel.series.rbegin(), panel.series.rend(),
                [&](const PrecisionSeries& series) { draw_series(context, axes, series, drawn); });
  if (panel.known_to > 0.0) name_unknown(context, area, panel.known_to, drawn);
  draw_labels(context, axes, panel, drawn);
  cairo_restore(context);
  axes.draw_frame(context);
  client::draw_text(context, area.x - kErrorLabelLeft, area.y + 0.5 * area.height, panel.error_label,
                    {.size = 13.0, .anchor = client::Anchor::middle, .upwards = true});
}

double draw_legend(cairo_t* context, double x, double y, double width, int columns, bool shows_front) {
  const int entries = kFamilyCount + (shows_front ? 1 : 0);
  for (int i = 0; i < entries; ++i) {
    const int row = i / columns;
    const double left = x + width * (i % columns);
    const double middle = y + kLegendRow * row + 8.0;
    std::string name = "no other is both faster and nearer";
    if (i < kFamilyCount) {
      const auto family = static_cast<Family>(i);
      client::set_colour(context, colour_of(family));
      cairo_set_line_width(context, 1.3);
      if (family != Family::other_setting) stroke(context, left, middle, left + 26.0, middle);
      draw_precision_mark(context, left + 13.0, middle, family, false);
      name = name_of(family);
    } else {
      client::set_colour(context, kFrontColour);
      cairo_set_line_width(context, 6.0);
      stroke(context, left, middle, left + 26.0, middle);
    }
    client::draw_text(context, left + 34.0, middle + 4.3, name, {.size = 12.5});
  }
  const int rows = (entries + columns - 1) / columns;
  return kLegendRow * rows;
}

}  // namespace cellcrush::bench
