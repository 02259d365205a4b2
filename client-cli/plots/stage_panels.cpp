#include "plots/stage_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chart/axes.h"
#include "terminal/number_text.h"

namespace cellcrush::client {

namespace {

constexpr double kTitle = 20.0;
constexpr double kGap = 14.0;
constexpr double kRowRoom = 60.0;        // minimum height of a row, including titles
constexpr double kRowPreference = 0.45;  // a scale larger by rows^this justifies that many rows
constexpr double kTitleWidth = 170.0;
constexpr double kShortTitleWidth = 108.0;  // without the time
constexpr double kNarrowWidth = 2.0 * kTitleWidth + kGap;
constexpr double kLongestBar = 120.0;
constexpr double kBarRoom = 18.0;
const TextStyle kPanelTitleStyle{.size = 12.5};

// Number of stages in each row, and their scale.
struct Rows {
  double scale = 0.0;
  std::vector<int> counts;
};

double cell_width(const Box& box, double scale, double width) {
  return std::max(scale * box.width(), width < kNarrowWidth ? kShortTitleWidth : kTitleWidth);
}

// Filled from the left, at least one stage a row.
std::vector<int> fill_rows(const std::vector<Box>& boxes, double scale, double width) {
  std::vector<int> counts;
  double used = 0.0;
  for (const Box& box : boxes) {
    const double cell = cell_width(box, scale, width);
    if (counts.empty() || used + kGap + cell > width) {
      counts.push_back(1);
      used = cell;
    } else {
      ++counts.back();
      used += kGap + cell;
    }
  }
  return counts;
}

// The heights of the rows, without titles and gaps.
std::vector<double> row_heights(const std::vector<Box>& boxes, const Rows& rows) {
  std::vector<double> heights;
  std::size_t i = 0;
  for (const int count : rows.counts) {
    heights.push_back(0.0);
    for (int k = 0; k < count; ++k, ++i) heights.back() = std::max(heights.back(), rows.scale * boxes[i].height());
  }
  return heights;
}

double height_of(const std::vector<Box>& boxes, const Rows& rows) {
  double height = static_cast<double>(rows.counts.size()) * (kTitle + kGap);
  for (const double row : row_heights(boxes, rows)) height += row;
  return height;
}

// Searches from the largest scale that fits the width downwards: a smaller scale needs fewer rows.
Rows find_rows(const std::vector<Box>& boxes, double width, double height) {
  double widest = 0.0;
  for (const Box& box : boxes) widest = std::max(widest, box.width());
  Rows best;
  double best_score = -1.0;
  for (double scale = width / widest; best_score < 0.0 || scale > best.scale / 50.0; scale *= 0.99) {
    const Rows rows{scale, fill_rows(boxes, scale, width)};
    const auto count = static_cast<double>(rows.counts.size());
    if (height_of(boxes, rows) > std::max(height, count * kRowRoom)) continue;
    const double score = scale / std::pow(count, kRowPreference);
    if (score <= best_score) continue;
    best_score = score;
    best = rows;
  }
  return best;
}

std::string stage_text(const LatticeStage& stage, std::size_t index, std::size_t count, bool has_time) {
  const std::string time = number_text(1e3 * stage.time_s) + " ms";
  const bool has_strain = stage.has_plates() || stage.strain > 0.0;  // also between rigid walls
  std::string text = has_strain ? fmt::format("strain {:.2f}", stage.strain) : time;
  if (has_time && has_strain && stage.time_s > 0.0) text += ", " + time;
  // Letters as used in captions, as long as there are enough.
  return count > 1 && count <= 26 ? fmt::format("({}) {}", static_cast<char>('a' + index), text) : text;
}

}  // namespace

void draw_scale_bar(cairo_t* context, double right, double y, double scale) {
  const double length = find_ticks(0.0, kLongestBar / scale, 3).step;
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

StagePanels lay_stages(const std::vector<LatticeStage>& stages, double left, double top, double width, double height) {
  StagePanels panels{.boxes = find_boxes(stages), .places = {}, .bar_right = left + width, .bottom = top};
  const std::vector<Box>& boxes = panels.boxes;
  const Rows rows = find_rows(boxes, width, height);
  panels.has_times = width >= kNarrowWidth || rows.counts.size() == boxes.size();
  const std::vector<double> heights = row_heights(boxes, rows);
  std::size_t i = 0;
  for (std::size_t row = 0; row < heights.size(); ++row) {
    double x = left;
    for (int k = 0; k < rows.counts[row]; ++k, ++i) {
      const double drawn = rows.scale * boxes[i].height();
      // Rows are aligned at the top, where the support plate of a crush along y is.
      panels.places.push_back({x, panels.bottom + kTitle, rows.scale * boxes[i].width(), drawn});
      x += cell_width(boxes[i], rows.scale, width) + kGap;
    }
    panels.bottom += kTitle + heights[row] + kGap;
  }
  panels.bar_y = panels.bottom;
  panels.bottom += kBarRoom;
  return panels;
}

void draw_stages(cairo_t* context, const StagePanels& panels, const std::vector<LatticeStage>& stages) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Rectangle& place = panels.places[i];
    const std::string title = stage_text(stages[i], i, stages.size(), panels.has_times);
    draw_text(context, place.x, place.y - 5.0, title, kPanelTitleStyle);
    draw_lattice(context, place, panels.boxes[i], stages[i]);
  }
  draw_scale_bar(context, panels.bar_right, panels.bar_y, drawing_scale(panels.places[0], panels.boxes[0]));
}

}  // namespace cellcrush::client
