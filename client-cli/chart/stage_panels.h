#pragma once

#include <vector>

#include "chart/canvas.h"
#include "chart/lattice_drawing.h"

namespace cellcrush::client {

/// Where the drawings of a lattice's stages stand in a picture, all at one scale, each with a title above it.
struct StagePanels {
  Box box;                        ///< of every drawing
  std::vector<Rectangle> places;  ///< of the drawings, titles not included, in rows from the left
  double bottom = 0.0;            ///< where the next part of the picture may begin
};

/// Arranges the stages in `width` from (left, top) down, in as many columns as draw them largest within a page's height;
/// a lattice that is not clearly wider than high stands in one row where that costs little. REQUIRES: stages is not empty.
StagePanels lay_stages(const std::vector<MeshFrame>& stages, double left, double top, double width);

/// Draws the stages with their letters, strains (a frame's: times) and a scale bar.
void draw_stages(cairo_t* context, const StagePanels& panels, const std::vector<MeshFrame>& stages);

}  // namespace cellcrush::client
