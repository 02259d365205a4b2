#pragma once

#include <vector>

#include "chart/canvas.h"
#include "chart/lattice_drawing.h"

namespace cellcrush::client {

/// Layout of the drawings of a lattice's stages in a picture, at one scale, each with a title above.
struct StagePanels {
  std::vector<Box> boxes{};         ///< of each drawing
  std::vector<Rectangle> places{};  ///< of the drawings without titles, in rows from the left
  double bar_right = 0.0;           ///< right end of the scale bar
  double bar_y = 0.0;               ///< vertical position of the scale bar
  double bottom = 0.0;              ///< top of the next part of the picture
  bool has_times = true;            ///< whether the titles of a crush have room for the time
};

/// Height of the stages of a picture for the screen.
inline constexpr double kStagesHeight = 660.0;

/// Arranges the stages in rows of `width` from (left, top) down, filled from the left. Stages are drawn from the impact
/// plate onwards, so that a crushed lattice needs less room. Chooses the number of rows that gives the largest scale
/// within `height` (more for many stages), preferring fewer rows if that costs little. REQUIRES: stages is not empty.
StagePanels lay_stages(const std::vector<LatticeStage>& stages, double left, double top, double width,
                       double height = kStagesHeight);

/// Draws a bar of a round length at a scale of units per mm, which ends at (right, y), with its length.
void draw_scale_bar(cairo_t* context, double right, double y, double scale);

/// Draws the stages with their letters, strains (times for a frame) and a scale bar.
void draw_stages(cairo_t* context, const StagePanels& panels, const std::vector<LatticeStage>& stages);

}  // namespace cellcrush::client
