#include "chart/movie_frame.h"

#include <algorithm>
#include <cmath>

#include "chart/colour_map.h"
#include "chart/stage_panels.h"

namespace cellcrush::client {

std::string render_movie_frame(const MeshFrame& stage, const Box& box) {
  constexpr double kWidth = 960.0;
  constexpr double kMargin = 16.0;
  constexpr double kTitle = 28.0;
  constexpr double kHighest = 480.0;  // of the drawing
  constexpr double kInner = kWidth - 2.0 * kMargin;
  static_assert(kPixelsPerUnit % 2 == 0, "whole units make an even number of pixels");
  const double drawn = std::ceil(std::min(kInner * box.height() / box.width(), kHighest));
  const StagePanels panels{.boxes = {box},
                           .places = {{kMargin, kMargin + kTitle, kInner, drawn}},
                           .bar_right = kMargin + kInner,
                           .bar_y = kMargin + kTitle - 9.0,
                           .bottom = 2.0 * kMargin + kTitle + drawn};
  const double height = panels.bottom + kColourBarHeight + kMargin;
  return render_picture(PictureFormat::png, kWidth, height, [&](cairo_t* context) {
    draw_stages(context, panels, {stage});
    draw_colour_bar(context, kWidth - kMargin - 6.0, panels.bottom, 150.0, "plastic fraction of the wall");
  });
}

}  // namespace cellcrush::client
