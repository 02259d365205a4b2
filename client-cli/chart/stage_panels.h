#pragma once

#include <vector>

#include "chart/canvas.h"
#include "chart/lattice_drawing.h"

namespace cellcrush::client {

/// Where the drawings of a lattice's stages stand in a picture, all at one scale, each with a title above it.
struct StagePanels {
  std::vector<Box> boxes{};         ///< of each drawing
  std::vector<Rectangle> places{};  ///< of the drawings, titles not included, in rows from the left
  double bar_right = 0.0;           ///< where the scale bar ends
  double bar_y = 0.0;               ///< the height of the scale bar in the picture
  double bottom = 0.0;              ///< where the next part of the picture may begin
};

/// Arranges the stages in `width` from (left, top) down: rows filled from the left, drawn from the impact plate on, so
/// that a crushed lattice takes less room than a whole one. Of all numbers of rows it chooses the one that draws them
/// largest within a page's height, fewer rows where that costs little. REQUIRES: stages is not empty.
StagePanels lay_stages(const std::vector<MeshFrame>& stages, double left, double top, double width);

/// Draws the stages with their letters, strains (a frame's: times) and a scale bar.
void draw_stages(cairo_t* context, const StagePanels& panels, const std::vector<MeshFrame>& stages);

}  // namespace cellcrush::client
