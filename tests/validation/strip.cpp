#include "validation/strip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "bench/picture_file.h"
#include "chart/colour_map.h"
#include "chart/lattice_drawing.h"

namespace cellcrush::validation {
namespace {

constexpr double kWidth = 700.0;
constexpr double kMargin = 10.0;
constexpr double kGap = 12.0;
constexpr double kTitle = 18.0;
constexpr double kFarthest = 0.03;  // of a frame's strain from the one that is asked
const client::TextStyle kTitleStyle{.size = 9.5};

const FieldFrame& nearest_frame(const StripRow& row, double strain) {
  const auto& frames = row.kept.frames;
  const auto away = [&](const FieldFrame& frame) { return std::abs(frame.strain - strain); };
  const auto found = std::min_element(frames.begin(), frames.end(),
                                      [&](const FieldFrame& a, const FieldFrame& b) { return away(a) < away(b); });
  if (found == frames.end() || away(*found) > kFarthest) {
    throw std::invalid_argument("strains: " + row.title + " has no frame near " + std::to_string(strain) +
                                "; ask for strains that the run has reached.");
  }
  return *found;
}

client::LatticeStage stage_of(const KeptFrames& kept, const FieldFrame& frame) {
  const MeshView& mesh = kept.mesh;
  return {.position_mm = frame.position,
          .element_nodes = mesh.element_nodes,
          .thickness_mm = mesh.thickness,
          .plastic_fraction = frame.plastic_fraction,
          .impact_plate_mm = mesh.impact_plate,
          .support_plate_mm = mesh.support_plate,
          .along_y = mesh.along_y,
          .strain = frame.strain,
          .time_s = frame.time};
}

std::string title_of(const StripRow& row, const FieldFrame& frame) {
  char text[64];
  std::snprintf(text, sizeof(text), "strain %.2f, %.1f mm", frame.strain, frame.strain * row.kept.mesh.length);
  return row.title.empty() ? text : row.title + ", " + text;
}

}  // namespace

void draw_strip(const std::string& file, const std::vector<StripRow>& rows, const std::vector<double>& strains) {
  std::vector<client::LatticeStage> stages;
  std::vector<std::string> titles;
  for (const StripRow& row : rows) {
    for (const double strain : strains) {
      const FieldFrame& frame = nearest_frame(row, strain);
      stages.push_back(stage_of(row.kept, frame));
      titles.push_back(title_of(row, frame));
    }
  }
  const client::Box box = client::find_box(stages);
  const auto columns = static_cast<double>(strains.size());
  const double width = (kWidth - 2.0 * kMargin - (columns - 1.0) * kGap) / columns;
  const double height = width * box.height() / box.width();
  const double bottom = kMargin + static_cast<double>(rows.size()) * (kTitle + height + kGap);
  bench::write_picture(file, kWidth, bottom + client::kColourBarHeight + kMargin, [&](cairo_t* context) {
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const std::size_t column = i % strains.size();
      const std::size_t row = i / strains.size();
      const double x = kMargin + static_cast<double>(column) * (width + kGap);
      const double y = kMargin + static_cast<double>(row) * (kTitle + height + kGap) + kTitle;
      client::draw_text(context, x, y - 5.0, titles[i], kTitleStyle);
      client::draw_lattice(context, {x, y, width, height}, box, stages[i]);
    }
    client::draw_colour_bar(context, kWidth - kMargin - 6.0, bottom, 150.0, "plastic fraction of the wall");
  });
}

}  // namespace cellcrush::validation
