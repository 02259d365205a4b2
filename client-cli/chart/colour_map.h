#pragma once

#include "chart/canvas.h"

namespace cellcrush::client {

/// Colour of a value from 0 (dark blue) to 1 (orange), with uniformly increasing brightness and readable on white.
Colour map_colour(double share);

/// Draws a horizontal colour bar with ticks 0, 0.5 and 1 below and `label` to the left. (x, y) is its upper right
/// corner.
void draw_colour_bar(cairo_t* context, double x, double y, double width, const std::string& label);

/// Height of the bar with its ticks.
inline constexpr double kColourBarHeight = 26.0;

}  // namespace cellcrush::client
