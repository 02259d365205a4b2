#include "bench/precision_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>

#include "chart/colour_map.h"

namespace cellcrush::bench {

bool overlap(const client::Rectangle& one, const client::Rectangle& other) {
  return one.x < other.x + other.width && other.x < one.x + one.width && one.y < other.y + other.height &&
         other.y < one.y + one.height;
}

namespace {

using client::Rectangle;

constexpr double kLabelHeight = 13.0;

/// A text that belongs to a mark.
struct MarkLabel {
  double x = 0.0;  ///< middle of the mark
  double y = 0.0;
  double width = 0.0;
  std::string words;
  client::Colour colour;
};

/// What a chart shows before its labels.
struct Drawn {
  std::vector<Rectangle> marks;  ///< no label covers one; labels are added
  std::vector<Rectangle> lines;  ///< a label avoids these where another place is free
};

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
  const double middle_y = label.y - up * (kMarkRadius + gap + 0.5 * kLabelHeight);
  return {middle_x - 0.5 * label.width, middle_y - 0.5 * kLabelHeight, label.width, kLabelHeight};
}

/// The place for a label near its mark, inside `area`, that covers no mark and no other label; none if there is no free
/// one.
std::optional<Rectangle> place_of(const MarkLabel& label, const Drawn& drawn, const Rectangle& area) {
  double least = std::numeric_limits<double>::infinity();
  std::optional<Rectangle> best;
  for (const double gap : kGaps) {
    for (int direction = 0; direction < kDirections; ++direction) {
      const double angle = 2.0 * std::numbers::pi * direction / kDirections;
      const Rectangle place = place_at(label, gap, angle);
      if (!lies_in(place, area) || !is_free(place, drawn.marks)) continue;
      const auto covered = std::count_if(drawn.lines.begin(), drawn.lines.end(),
                                         [&](const Rectangle& line) { return overlap(place, line); });
      const double cost = gap + kSideCost * (1.0 - std::cos(angle)) + kLineCost * static_cast<double>(covered);
      if (cost < least) {
        least = cost;
        best = place;
      }
    }
  }
  return best;
}

using client::Axes;

constexpr double kTitleHeight = 24.0;
constexpr double kLegendRow = 21.0;
constexpr double kBarEnd = 3.0;
constexpr double kLeaderFrom = 5.0;  ///< a label farther than this from its mark's edge is tied to it by a line
constexpr client::Colour kFrontColour{0.86, 0.86, 0.87};
constexpr client::Colour kUnknownColour{0.945, 0.945, 0.93};
constexpr double kLabelSize = 11.5;
constexpr double kErrorLabelLeft = 54.0;  ///< of the axis, beyond its widest numbers

constexpr double kRadius = 4.6;
constexpr client::Colour kSettingColour{0.45, 0.45, 0.49};
constexpr std::array<client::Colour, kFamilyCount> kColours = {client::kSeriesColours[0], client::kSeriesColours[1],
                                                               client::kSeriesColours[2], kSettingColour};
constexpr double kTextShare = 0.8;  ///< of the mark's colour

void add_path(cairo_t* context, double x, double y, Family family) {
  cairo_new_path(context);
  switch (family) {
    case Family::force_based: cairo_arc(context, x, y, kRadius, 0.0, 2.0 * std::numbers::pi); break;
    case Family::displacement_based:
      cairo_rectangle(context, x - 0.85 * kRadius, y - 0.85 * kRadius, 1.7 * kRadius, 1.7 * kRadius);
      break;
    case Family::papers:
      cairo_move_to(context, x, y - 1.15 * kRadius);
      cairo_line_to(context, x + 1.1 * kRadius, y + 0.85 * kRadius);
      cairo_line_to(context, x - 1.1 * kRadius, y + 0.85 * kRadius);
      break;
    default:
      cairo_move_to(context, x, y - kRadius);
      cairo_line_to(context, x + kRadius, y);
      cairo_line_to(context, x, y + kRadius);
      cairo_line_to(context, x - kRadius, y);
  }
  cairo_close_path(context);
}

client::Colour colour_of(Family family) { return kColours[static_cast<std::size_t>(family)]; }

/// Dark enough to be read as text.
client::Colour text_colour_of(Family family) {
  const client::Colour colour = colour_of(family);
  return {kTextShare * colour.red, kTextShare * colour.green, kTextShare * colour.blue};
}

/// A family's mark round (x, y); `open` where only a bound of the error is known.
void draw_precision_mark(cairo_t* context, double x, double y, Family family, bool open) {
  add_path(context, x, y, family);
  client::set_colour(context, open ? client::Colour{1.0, 1.0, 1.0} : colour_of(family));
  cairo_fill_preserve(context);
  client::set_colour(context, colour_of(family));
  cairo_set_line_width(context, 1.5);
  cairo_stroke(context);
}

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

void draw_label(cairo_t* context, const MarkLabel& label, const Rectangle& place) {
  const double x = std::clamp(label.x, place.x, place.x + place.width);
  const double y = std::clamp(label.y, place.y + 2.0, place.y + place.height - 2.0);
  const double distance = std::hypot(x - label.x, y - label.y);
  if (distance > 6.0 + kLeaderFrom) {
    cairo_set_line_width(context, 0.7);
    client::set_colour(context, {label.colour.red, label.colour.green, label.colour.blue, 0.7});
    const double start = 6.0 / distance;
    stroke(context, label.x + start * (x - label.x), label.y + start * (y - label.y), x, y);
  }
  client::draw_text(context, place.x + 1.0, place.y + place.height - 3.0, label.words,
                    {.size = kLabelSize, .colour = label.colour});
}

/// The first labels choose first; one that finds no free place has none.
void draw_labels(cairo_t* context, const Axes& axes, const PrecisionPanel& panel, Drawn& drawn) {
  const Rectangle& area = axes.area();
  const Rectangle inside{area.x + 3.0, area.y + 3.0, area.width - 6.0, area.height - 6.0};
  for (const PrecisionSeries& series : panel.series) {
    if (series.family == Family::other_setting && !panel.labels_settings) continue;
    for (const PrecisionPoint& point : series.points) {
      const double width = client::text_width(context, point.label, {.size = kLabelSize}) + 4.0;
      const MarkLabel label{axes.x(point.seconds), axes.y(point.error), width, point.label,
                            text_colour_of(series.family)};
      if (const auto place = place_of(label, drawn, inside)) {
        drawn.marks.push_back(*place);
        draw_label(context, label, *place);
      }
    }
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
