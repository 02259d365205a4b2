#pragma once

#include "chart/chart.h"

namespace cellcrush::client {

/// Draws a mark with its middle at (x, y). A disc and a triangle are full, a square and a diamond open and a cross two
/// strokes, so that they can be told apart without their colours.
void draw_marker(cairo_t* context, double x, double y, Marker marker, const Colour& colour);

/// Draws the arrow and the text of a curve that leaves the chart; `room` units below its upper side are taken.
void draw_overshoot(cairo_t* context, const Axes& axes, const Overshoot& overshoot, double room);

/// Draws what stands at the points of a curve: bars, marks and labels. Points that are not finite have none.
void draw_marks(cairo_t* context, const Axes& axes, const Curve& curve);

}  // namespace cellcrush::client
