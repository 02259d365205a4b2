#pragma once

#include <string>
#include <vector>

#include "bench/precision_series.h"
#include "chart/axes.h"

namespace cellcrush::bench {

/// Time against error of one measure. Both axes are logarithmic.
struct PrecisionPanel {
  std::string title;
  std::string error_label;  ///< along the axis of errors, with the unit
  client::Axis x;
  client::Axis y;
  std::vector<PrecisionSeries> series;
  double known_to = 0.0;  ///< half of the reference's 95 % interval, in per cent: errors below cannot be seen; 0: none
  bool labels_settings = true;
  bool shows_front = true;
};

/// Whether two rectangles share more than an edge.
bool overlap(const client::Rectangle& one, const client::Rectangle& other);

/// Sets the axes' ranges round all points.
void fit_axes(PrecisionPanel& panel);

/// Draws title, axes, points and labels into `place`.
void draw_panel(cairo_t* context, const client::Rectangle& place, const PrecisionPanel& panel);

/// Draws the four families with their marks in columns from (x, y), `columns` beside each other and `width` apart, and
/// answers the height.
double draw_legend(cairo_t* context, double x, double y, double width, int columns, bool shows_front);

}  // namespace cellcrush::bench
