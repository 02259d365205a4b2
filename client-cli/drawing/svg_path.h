#pragma once

#include <string_view>
#include <vector>

#include "drawing/drawing.h"

namespace cellcrush::drawing {

/// The numbers of a text of SVG, which blanks, commas or signs part. Throws CommandError (refused) on anything else.
std::vector<double> svg_numbers(std::string_view text);

/// The chains of chords of a path's data: M, L, H, V, Z as they are; C, S, Q, T and A in chords of which 16 make a
/// curve. Throws CommandError (refused) on data that is none.
std::vector<std::vector<DrawnPlace>> flatten_svg_path(std::string_view data);

}  // namespace cellcrush::drawing
