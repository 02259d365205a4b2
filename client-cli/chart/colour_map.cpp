#include "chart/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cellcrush::client {

namespace {

// Stops of matplotlib's "plasma" (public domain, CC0) up to 0.8; brighter colours are invisible on white.
constexpr std::array<Colour, 9> kStops = {{{0.050, 0.030, 0.528},
                                           {0.204, 0.018, 0.594},
                                           {0.325, 0.007, 0.640},
                                           {0.440, 0.002, 0.658},
                                           {0.548, 0.040, 0.648},
                                           {0.650, 0.125, 0.600},
                                           {0.760, 0.240, 0.500},
                                           {0.870, 0.370, 0.385},
                                           {0.960, 0.540, 0.245}}};

}  // namespace

Colour map_colour(double share) {
  const double position = (std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0) * (kStops.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
  const double weight = position - static_cast<double>(below);
  const Colour& a = kStops[below];
  const Colour& b = kStops[below + 1];
  return {std::lerp(a.red, b.red, weight), std::lerp(a.green, b.green, weight), std::lerp(a.blue, b.blue, weight)};
}

void draw_colour_bar(cairo_t* context, double x, double y, double width, const std::string& label) {
  constexpr double kHeight = 10.0;
  const double left = x - width;
  cairo_pattern_t* gradient = cairo_pattern_create_linear(left, 0.0, x, 0.0);
  for (std::size_t i = 0; i < kStops.size(); ++i) {
    const double share = static_cast<double>(i) / (kStops.size() - 1);
    cairo_pattern_add_color_stop_rgb(gradient, share, kStops[i].red, kStops[i].green, kStops[i].blue);
  }
  cairo_rectangle(context, left, y, width, kHeight);
  cairo_set_source(context, gradient);
  cairo_fill(context);
  cairo_pattern_destroy(gradient);
  const TextStyle mark{.size = 11.0, .anchor = Anchor::middle};
  draw_text(context, left, y + 23.0, "0", mark);
  draw_text(context, left + 0.5 * width, y + 23.0, "0.5", mark);
  draw_text(context, x, y + 23.0, "1", mark);
  draw_text(context, left - 10.0, y + 9.5, label, {.size = 12.0, .anchor = Anchor::right});
}

}  // namespace cellcrush::client
