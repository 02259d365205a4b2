#pragma once

#include "bench/precision_series.h"
#include "chart/canvas.h"

namespace cellcrush::bench {

client::Colour colour_of(Family family);

/// Dark enough to be read as text.
client::Colour text_colour_of(Family family);

/// A family's mark round (x, y); `open` where only a bound of the error is known.
void draw_precision_mark(cairo_t* context, double x, double y, Family family, bool open);

}  // namespace cellcrush::bench
