#pragma once

#include "chart/chart.h"

namespace cellcrush::client {

/// Draws a mark centred at (x, y). Disc and triangle are filled, square and diamond open, and the cross is two strokes,
/// so that marks differ without colour.
void draw_marker(cairo_t* context, double x, double y, Marker marker, const Colour& colour);

/// Draws the arrow and text of a curve that leaves the chart; `room` units below the upper edge are occupied.
void draw_overshoot(cairo_t* context, const Axes& axes, const Overshoot& overshoot, double room);

/// Draws bars, marks and labels at the points of a curve. Skips points that are not finite.
void draw_marks(cairo_t* context, const Axes& axes, const Curve& curve);

}  // namespace cellcrush::client
