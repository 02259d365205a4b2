#pragma once

#include <string>
#include <vector>

#include "chart/canvas.h"
#include "stability/map_grid.h"

namespace cellcrush::stability {

/// The bytes of a picture of a grid: a panel a speed, steps across, penalties up, the energy error in each cell, and a
/// ring where the solver's own choice lies. REQUIRES: `results` are those of the grid, `defaults` one a speed.
std::string draw_map(client::PictureFormat format, const Grid& grid, const std::vector<Result>& results,
                     const std::vector<Point>& defaults, const std::string& title);

}  // namespace cellcrush::stability
