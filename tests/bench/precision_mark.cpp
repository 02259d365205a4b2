#include "bench/precision_mark.h"

#include <array>
#include <numbers>

#include "chart/palette.h"

namespace cellcrush::bench {
namespace {

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

}  // namespace

client::Colour colour_of(Family family) { return kColours[static_cast<std::size_t>(family)]; }

client::Colour text_colour_of(Family family) {
  const client::Colour colour = colour_of(family);
  return {kTextShare * colour.red, kTextShare * colour.green, kTextShare * colour.blue};
}

void draw_precision_mark(cairo_t* context, double x, double y, Family family, bool open) {
  add_path(context, x, y, family);
  client::set_colour(context, open ? client::Colour{1.0, 1.0, 1.0} : colour_of(family));
  cairo_fill_preserve(context);
  client::set_colour(context, colour_of(family));
  cairo_set_line_width(context, 1.5);
  cairo_stroke(context);
}

}  // namespace cellcrush::bench
