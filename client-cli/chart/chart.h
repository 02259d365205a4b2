#pragma once

#include <string>
#include <vector>

#include "chart/axes.h"

namespace cellcrush::client {

/// Style of a line; `dashes` are lengths on and off, empty for a solid line. Width 0 draws none.
struct LineStyle {
  Colour colour = kInk;
  double width = 1.5;
  std::vector<double> dashes;
};

/// Mark at a point of a curve, in the colour of its line.
enum class Marker { none, disc, square, triangle, diamond, cross };

/// A line through points with marks; x and y have equal length. Without a name it is not in the legend. `low`, `high`
/// and `labels` are empty or as long: ends of an error bar at each point, and a small text beside it.
struct Curve {
  std::vector<double> x;
  std::vector<double> y;
  LineStyle style;
  std::string name;
  Marker marker = Marker::none;
  std::vector<double> low = {};
  std::vector<double> high = {};
  std::vector<std::string> labels = {};
};

/// A horizontal line.
Curve level_curve(double value, double from, double to, LineStyle style, std::string name);

/// A shaded range of x with a small text at its top.
struct Band {
  double from = 0.0;
  double to = 0.0;
  std::string text;
};

/// A vertical dotted line at an x, with a small text along it.
struct Mark {
  double x = 0.0;
  std::string text;
  Colour colour = kMutedInk;
};

/// A small arrow at the upper edge where a curve leaves the chart, with a text giving its maximum.
struct Overshoot {
  double x = 0.0;
  std::string text;
  Colour colour;
};

/// Curves over common axes with a legend above. Later lines cover earlier ones, and marks cover lines.
struct Chart {
  Axis x;
  Axis y;
  std::vector<Band> bands;
  std::vector<Mark> marks;
  std::vector<Curve> curves;
  std::vector<Overshoot> overshoots;
  std::string note;  ///< small, below the axis on the right; may be empty
};

/// Multiplies y and its axis, in other words shows it in another unit.
void scale_y(Chart& chart, double factor);

/// Height of a note within `width`.
double note_height(cairo_t* context, double width, const std::string& note);

/// Draws a small muted text whose lines end at `right`, the first at `y`.
void draw_note(cairo_t* context, double right, double y, double width, const std::string& note);

/// Draws a chart into `place`, legend, labels and note included.
void draw_chart(cairo_t* context, const Rectangle& place, const Chart& chart);

}  // namespace cellcrush::client
