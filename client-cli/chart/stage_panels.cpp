#include "chart/stage_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chart/ticks.h"
#include "terminal/number_text.h"

namespace cellcrush::client {

namespace {

constexpr double kTitle = 20.0;
constexpr double kGap = 14.0;
constexpr double kPage = 880.0;      // height of all stages
constexpr double kWideAspect = 1.7;  // from here on a lattice is clearly wider than high
constexpr double kRowPreference = 1.35;
const TextStyle kPanelTitleStyle{.size = 12.5};

struct Grid {
  int columns = 1;
  int rows = 1;
  double width = 0.0;   ///< of a drawing
  double height = 0.0;  ///< of a drawing
};

Grid find_grid(int count, double aspect, double width) {
  Grid best;
  double best_score = -1.0;
  for (int columns = 1; columns <= count; ++columns) {
    Grid grid{columns, (count + columns - 1) / columns};
    grid.width = (width - (columns - 1) * kGap) / columns;
    const double room = kPage / grid.rows - kTitle - kGap;
    if (room <= 0.0) continue;
    grid.height = std::min(grid.width / aspect, room);
    // Places that stay empty count against the grid.
    double score = grid.height * count / (grid.columns * grid.rows);
    if (grid.rows == 1 && aspect < kWideAspect) score *= kRowPreference;
    if (score <= best_score) continue;
    best_score = score;
    best = grid;
  }
  return best;
}

std::string stage_text(const MeshFrame& stage, std::size_t index, std::size_t count) {
  const std::string time = number_text(1e3 * stage.frame.time_s()) + " ms";
  std::string text = has_plates(stage.mesh) ? fmt::format("strain {:.2f}", stage.frame.strain()) : time;
  if (has_plates(stage.mesh) && stage.frame.time_s() > 0.0) text += ", " + time;
  // Letters as a caption names them, as long as there are enough.
  return count > 1 && count <= 26 ? fmt::format("({}) {}", static_cast<char>('a' + index), text) : text;
}

// A bar of a round length at the right end of a panel's title.
void draw_scale_bar(cairo_t* context, const Rectangle& place, const Box& box) {
  const double scale = drawing_scale(place, box);
  const double longest = 0.2 * place.width / scale;
  const double length = find_ticks(0.0, longest, 3).step;
  const double right = place.x + place.width;
  const double y = place.y - 9.0;
  const double left = right - scale * length;
  cairo_set_line_width(context, 1.6);
  set_colour(context, kInk);
  cairo_move_to(context, left, y);
  cairo_line_to(context, right, y);
  for (const double end : {left, right}) {
    cairo_move_to(context, end, y - 3.0);
    cairo_line_to(context, end, y + 3.0);
  }
  cairo_stroke(context);
  draw_text(context, left - 6.0, y + 4.0, fmt::format("{} mm", length), {.size = 11.0, .anchor = Anchor::right});
}

}  // namespace

StagePanels lay_stages(const std::vector<MeshFrame>& stages, double left, double top, double width) {
  StagePanels panels{find_box(stages), {}, top};
  const Grid grid = find_grid(static_cast<int>(stages.size()), panels.box.width() / panels.box.height(), width);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const int row = static_cast<int>(i) / grid.columns;
    const int column = static_cast<int>(i) % grid.columns;
    const double y = top + row * (kTitle + grid.height + kGap) + kTitle;
    panels.places.push_back({left + column * (grid.width + kGap), y, grid.width, grid.height});
  }
  panels.bottom = top + grid.rows * (kTitle + grid.height + kGap);
  return panels;
}

void draw_stages(cairo_t* context, const StagePanels& panels, const std::vector<MeshFrame>& stages) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Rectangle& place = panels.places[i];
    draw_text(context, place.x, place.y - 5.0, stage_text(stages[i], i, stages.size()), kPanelTitleStyle);
    draw_lattice(context, place, panels.box, stages[i]);
  }
  draw_scale_bar(context, panels.places.back(), panels.box);
}

}  // namespace cellcrush::client
