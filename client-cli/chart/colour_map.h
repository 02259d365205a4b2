#pragma once

#include <array>

#include "chart/canvas.h"
#include "chart/chart.h"

namespace cellcrush::client {

inline constexpr Colour kImpactColour{0.76, 0.20, 0.16};
inline constexpr Colour kSupportColour{0.10, 0.38, 0.66};

/// The colours of Okabe and Ito that contrast with white; distinguishable for colour-blind readers.
inline constexpr std::array<Colour, 6> kSeriesColours = {{{0.00, 0.45, 0.70},
                                                          {0.84, 0.37, 0.00},
                                                          {0.00, 0.62, 0.45},
                                                          {0.80, 0.47, 0.65},
                                                          {0.90, 0.62, 0.00},
                                                          {0.34, 0.71, 0.91}}};

/// The marks used with them, in turn.
inline constexpr std::array<Marker, 4> kSeriesMarkers = {Marker::disc, Marker::square, Marker::triangle,
                                                         Marker::diamond};

/// Colour of a value from 0 (dark blue) to 1 (orange), with uniformly increasing brightness and readable on white.
Colour map_colour(double share);

/// Draws a horizontal colour bar with ticks 0, 0.5 and 1 below and `label` to the left. (x, y) is its upper right
/// corner.
void draw_colour_bar(cairo_t* context, double x, double y, double width, const std::string& label);

/// Height of the bar with its ticks.
inline constexpr double kColourBarHeight = 26.0;

}  // namespace cellcrush::client
