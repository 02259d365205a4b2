#pragma once

#include "chart/canvas.h"

namespace cellcrush::client {

/// Colour of a share from 0 (dark blue) to 1 (orange), evenly brighter and readable on white.
Colour map_colour(double share);

/// Draws a horizontal colour bar with the marks 0, 0.5 and 1 below it and `label` on its left. (x, y) is the bar's
/// upper right corner.
void draw_colour_bar(cairo_t* context, double x, double y, double width, const std::string& label);

/// Height of the bar with its marks.
inline constexpr double kColourBarHeight = 26.0;

}  // namespace cellcrush::client
