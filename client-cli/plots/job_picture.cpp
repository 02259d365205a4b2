#include "plots/job_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chart/colour_map.h"
#include "plots/job_curves.h"
#include "plots/stage_panels.h"
#include "terminal/case_text.h"
#include "terminal/summary_text.h"

namespace cellcrush::client {

namespace {

constexpr double kWidth = 1000.0;
constexpr double kSweepWidth = 720.0;
constexpr double kMargin = 26.0;
constexpr double kInner = kWidth - 2.0 * kMargin;
constexpr double kTitleHeight = 50.0;
constexpr double kColourBarRoom = 350.0;  // of the subtitle's line
constexpr double kChartHeight = 400.0;
constexpr double kEnergyHeight = 300.0;
constexpr double kChartGap = 14.0;
const TextStyle kTitleStyle{.size = 18.0, .bold = true};
const TextStyle kSubtitleStyle{.size = 12.5, .colour = kMutedInk};

void draw_title(cairo_t* context, const std::string& title, const std::string& subtitle, double width,
                double subtitle_width) {
  draw_text(context, kMargin, kMargin + 14.0, fit_text(context, title, width, kTitleStyle), kTitleStyle);
  draw_text(context, kMargin, kMargin + 36.0, fit_text(context, subtitle, subtitle_width, kSubtitleStyle),
            kSubtitleStyle);
}

// (right, top) is the corner of the bar.
void draw_plastic_bar(cairo_t* context, double top) {
  draw_colour_bar(context, kWidth - kMargin - 6.0, top, 150.0, "plastic fraction of the wall");
}

std::string subtitle_of(const v1::Job& job) {
  const std::string scene = scene_text(job.words());
  std::string text = scene.empty() ? job.name() : scene;
  const v1::Summary::CrushMode mode = job.summary().crush_mode();
  if (mode != v1::Summary::CRUSH_MODE_UNSPECIFIED && mode != v1::Summary::CRUSH_MODE_NONE)
    text += ", " + job.summary().crush_mode_words();
  if (job.state() != v1::Job::SUCCEEDED) text += ", " + v1::Job::State_Name(job.state());
  return text;
}

std::vector<LatticeStage> lattice_stages(const std::vector<MeshFrame>& frames) {
  std::vector<LatticeStage> stages;
  for (const MeshFrame& frame : frames) stages.push_back(lattice_stage(frame));
  return stages;
}

std::string sweep_subtitle(const SweepResults& results) {
  const v1::SweepTable& table = results.table;
  std::string fields;
  for (const std::string& field : table.fields()) fields += (fields.empty() ? "" : ", ") + axis_label(field);
  return fmt::format("{} jobs over {}   ({})", table.rows_size(), fields, results.sweep.name());
}

}  // namespace

LatticeStage lattice_stage(const MeshFrame& frame) {
  const auto& [field, mesh] = frame;
  return {.position_mm = {field.position_mm().begin(), field.position_mm().end()},
          .element_nodes = {mesh.element_nodes().begin(), mesh.element_nodes().end()},
          .thickness_mm = {mesh.thickness_mm().begin(), mesh.thickness_mm().end()},
          .plastic_fraction = {field.plastic_fraction().begin(), field.plastic_fraction().end()},
          .impact_plate_mm = mesh.impact_plate_mm(),
          .support_plate_mm = mesh.support_plate_mm(),
          .along_y = mesh.along_y(),
          .strain = field.strain(),
          .time_s = field.time_s()};
}

std::string render_job_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& frames) {
  const std::vector<LatticeStage> stages = lattice_stages(frames);
  constexpr double kTop = kMargin + kTitleHeight;
  const StagePanels panels = stages.empty() ? StagePanels{.bottom = kTop} : lay_stages(stages, kMargin, kTop, kInner);
  const bool plates = history.job.words().plates();
  const double curves_bottom = panels.bottom + kChartHeight + kChartGap;
  const double height = curves_bottom + (plates ? kEnergyHeight : 0.0) + kMargin;
  return render_picture(format, kWidth, height, [&](cairo_t* context) {
    draw_title(context, fmt::format("{} ({})", picture_name(history.job), history.job.name()), subtitle_of(history.job),
               kInner, kInner - kColourBarRoom);
    if (!stages.empty()) {
      draw_plastic_bar(context, kMargin + 26.0);
      draw_stages(context, panels, stages);
    }
    draw_chart(context, {kMargin, panels.bottom, kInner, kChartHeight},
               plates ? build_job_chart(history) : build_node_chart(history));
    if (plates) draw_chart(context, {kMargin, curves_bottom, kInner, kEnergyHeight}, build_energy_chart(history));
  });
}

std::string render_wide_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& frames) {
  const std::vector<LatticeStage> stages = lattice_stages(frames);
  constexpr double kTop = kMargin + kTitleHeight;
  constexpr double kLeft = 0.42 * kInner;
  constexpr double kChartLeft = kMargin + kLeft + kChartGap;
  const StagePanels panels = lay_stages(stages, kMargin, kTop, kLeft);
  const double height = std::max(panels.bottom - kTop, kChartHeight);
  return render_picture(format, kWidth, kTop + height + kMargin, [&](cairo_t* context) {
    draw_title(context, fmt::format("{} ({})", picture_name(history.job), history.job.name()), subtitle_of(history.job),
               kInner, kInner - kColourBarRoom);
    draw_plastic_bar(context, kMargin + 26.0);
    draw_stages(context, panels, stages);
    draw_chart(context, {kChartLeft, kTop, kWidth - kMargin - kChartLeft, height},
               history.job.words().plates() ? build_job_chart(history) : build_node_chart(history));
  });
}

std::string render_stages_picture(PictureFormat format, const std::vector<MeshFrame>& frames) {
  const std::vector<LatticeStage> stages = lattice_stages(frames);
  constexpr double kNarrowMargin = 12.0;
  const StagePanels panels = lay_stages(stages, kMargin, kNarrowMargin, kInner);
  const double height = panels.bottom + kColourBarHeight + kNarrowMargin;
  return render_picture(format, kWidth, height, [&](cairo_t* context) {
    draw_stages(context, panels, stages);
    draw_plastic_bar(context, panels.bottom);
  });
}

std::string render_comparison_picture(PictureFormat format, const std::vector<JobHistory>& histories) {
  const double height =
      kMargin + kTitleHeight + 1.2 * kChartHeight + 20.0 * static_cast<double>(histories.size()) + kMargin;
  return render_picture(format, kWidth, height, [&](cairo_t* context) {
    draw_title(context, fmt::format("{} jobs compared", histories.size()), "plate stress against nominal strain",
               kInner, kInner);
    const double top = kMargin + kTitleHeight;
    draw_chart(context, {kMargin, top, kInner, height - top - kMargin}, build_comparison_chart(histories));
  });
}

std::string render_sweep_picture(PictureFormat format, const std::vector<SweepResults>& sweeps,
                                 const LogarithmicAxes& logarithmic) {
  constexpr double kTop = kMargin + kTitleHeight;
  constexpr double kInnerWidth = kSweepWidth - 2.0 * kMargin;
  const Chart chart = build_sweep_chart(sweeps, logarithmic);
  // A legend of many series takes more lines.
  const double chart_height = kChartHeight + 60.0 + 8.0 * static_cast<double>(chart.curves.size());
  const std::string& title = sweeps.front().sweep.case_().title();
  return render_picture(format, kSweepWidth, kTop + chart_height + kMargin, [&](cairo_t* context) {
    if (sweeps.size() > 1) {
      draw_title(context, "Plateau stress", fmt::format("{} sweeps over {}", sweeps.size(), chart.x.label), kInnerWidth,
                 kInnerWidth);
    } else {
      draw_title(context, title.empty() ? "Plateau stress" : title, sweep_subtitle(sweeps.front()), kInnerWidth,
                 kInnerWidth);
    }
    draw_chart(context, {kMargin, kTop, kInnerWidth, chart_height}, chart);
  });
}

std::string render_movie_frame(const LatticeStage& stage, const Box& box) {
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
