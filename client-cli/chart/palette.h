#pragma once

#include <array>

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

}  // namespace cellcrush::client
