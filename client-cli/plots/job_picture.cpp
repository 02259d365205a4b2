#include "plots/job_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "chart/colour_map.h"
#include "plots/job_curves.h"
#include "plots/stage_panels.h"
#include "plots/sweep_map.h"
#include "terminal/case_text.h"
#include "terminal/summary_text.h"
#include "terminal/sweep_text.h"

namespace cellcrush::client {

namespace {

constexpr double kWidth = 1000.0;
constexpr double kSweepWidth = 720.0;
constexpr double kMargin = 26.0;
constexpr double kTitleHeight = 50.0;
constexpr double kColourBarRoom = 350.0;  // of the subtitle's line
constexpr double kChartHeight = 400.0;
constexpr double kEnergyHeight = 300.0;
constexpr double kChartGap = 14.0;
constexpr double kPrintedPageMm = 240.0;  // the height between the margins of a page
constexpr double kStagesShare = 0.24;     // of the height of a printed picture that has two charts
constexpr double kStressShare = 0.56;     // of the height of the two charts
constexpr double kLeastCharts = 560.0;    // height of the two charts
const TextStyle kTitleStyle{.size = 18.0, .bold = true};
const TextStyle kSubtitleStyle{.size = 12.5, .colour = kMutedInk};

// Where the parts of a picture are: one of a given width in print has no title and hardly a margin, and fits on a page.
struct Page {
  double width;
  double margin;
  double top;     ///< below the title
  double height;  ///< of all parts below it, at most

  Page(const PrintSize& print, double default_width)
      : width(print.width(default_width)),
        margin(print.width_mm > 0.0 ? 4.0 : kMargin),
        top(margin + (print.width_mm > 0.0 ? 0.0 : kTitleHeight)),
        height(print.width_mm > 0.0 ? kPrintedPageMm / 25.4 * 96.0 / print.scale() - 2.0 * margin
                                    : std::numeric_limits<double>::infinity()) {}

  [[nodiscard]] double inner() const { return width - 2.0 * margin; }
  [[nodiscard]] bool has_title() const { return top > margin; }
  // The height of a chart: hardly more than its width.
  [[nodiscard]] double chart_height(double highest) const { return std::min(highest, std::max(1.2 * inner(), 240.0)); }
};

void draw_title(cairo_t* context, const Page& page, const std::string& title, const std::string& subtitle,
                double subtitle_room = 0.0) {
  if (!page.has_title()) return;
  const double width = page.inner();
  const double subtitle_width = width - subtitle_room;
  draw_text(context, kMargin, kMargin + 14.0, fit_text(context, title, width, kTitleStyle), kTitleStyle);
  draw_text(context, kMargin, kMargin + 36.0, fit_text(context, subtitle, subtitle_width, kSubtitleStyle),
            kSubtitleStyle);
}

void draw_plastic_bar(cairo_t* context, const Page& page, double top) {
  const double width = std::min(150.0, 0.4 * page.inner());
  draw_colour_bar(context, page.width - page.margin - 6.0, top, width, "plastic fraction of the wall");
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

std::vector<LatticeStage> lattice_stages(const std::vector<MeshFrame>& frames, const RigidWalls& rigid_walls) {
  std::vector<LatticeStage> stages;
  for (const MeshFrame& frame : frames) stages.push_back(lattice_stage(frame, rigid_walls));
  return stages;
}

std::string sweep_subtitle(const SweepResults& results) {
  const v1::SweepTable& table = results.table;
  std::string fields;
  for (const std::string& field : table.fields()) fields += (fields.empty() ? "" : ", ") + axis_label(field);
  return fmt::format("{} over {}   ({})", job_count_text(results.sweep.jobs_size()), fields, results.sweep.name());
}

// One chart of several jobs, titled by the first if there is no other.
std::string render_jobs_chart(PictureFormat format, const v1::Job& first, std::size_t jobs, bool has_test,
                              const std::string& subtitle, const Chart& chart, const PrintSize& print) {
  const Page page(print, kWidth);
  const double chart_height = page.chart_height(1.2 * kChartHeight) + 20.0 * static_cast<double>(jobs);
  return render_picture(
      format, page.width, page.top + chart_height + page.margin,
      [&](cairo_t* context) {
        const std::string title = jobs == 1 ? picture_name(first) : fmt::format("{} jobs compared", jobs);
        draw_title(context, page, title + (has_test ? " and a test" : ""), subtitle);
        draw_chart(context, {page.margin, page.top, page.inner(), chart_height}, chart);
      },
      print);
}

}  // namespace

LatticeStage lattice_stage(const MeshFrame& frame, const RigidWalls& rigid_walls) {
  const auto& [field, mesh] = frame;
  return {.position_mm = {field.position_mm().begin(), field.position_mm().end()},
          .element_nodes = {mesh.element_nodes().begin(), mesh.element_nodes().end()},
          .thickness_mm = {mesh.thickness_mm().begin(), mesh.thickness_mm().end()},
          .plastic_fraction = {field.plastic_fraction().begin(), field.plastic_fraction().end()},
          .rigid_elements = mesh.rigid_element_count(),
          .overlap_particle = {mesh.overlap_particle().begin(), mesh.overlap_particle().end()},
          .impact_plate_mm = mesh.impact_plate_mm(),
          .support_plate_mm = mesh.support_plate_mm(),
          .along_y = mesh.along_y(),
          .side_low_mm = mesh.side_low_mm(),
          .side_high_mm = mesh.side_high_mm(),
          .gripped = {mesh.gripped().begin(), mesh.gripped().end()},
          .faces = rigid_walls.at(field.time_s(), mesh),
          .strain = field.strain(),
          .time_s = field.time_s()};
}

std::string render_job_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& frames,
                               const PrintSize& print) {
  const std::vector<LatticeStage> stages = lattice_stages(frames, {history.job.case_(), history.samples});
  const Page page(print, kWidth);
  const double bar_room = stages.empty() || page.has_title() ? 0.0 : kColourBarHeight + kChartGap;
  const bool plates = has_strain(history.job.words());
  const double most = std::min(kStagesHeight, (plates ? kStagesShare : 0.5) * page.height);
  const StagePanels panels =
      stages.empty() ? StagePanels{.bottom = page.top} : lay_stages(stages, page.margin, page.top, page.inner(), most);
  const double chart_top = panels.bottom + bar_room;
  const double room = page.height - (chart_top - page.top) - kChartGap;  // of the charts
  const bool has_second = plates && room >= kLeastCharts;
  const double chart_height = std::min(page.chart_height(kChartHeight), (has_second ? kStressShare : 1.0) * room);
  const double energy_top = chart_top + chart_height + kChartGap;
  const double energy_height =
      has_second ? std::min(page.chart_height(kEnergyHeight), (1.0 - kStressShare) * room) : 0.0;
  return render_picture(
      format, page.width, energy_top + energy_height + page.margin,
      [&](cairo_t* context) {
        draw_title(context, page, fmt::format("{} ({})", picture_name(history.job), history.job.name()),
                   subtitle_of(history.job), kColourBarRoom);
        if (!stages.empty()) {
          draw_plastic_bar(context, page, page.has_title() ? page.margin + 26.0 : panels.bottom);
          draw_stages(context, panels, stages);
        }
        draw_chart(context, {page.margin, chart_top, page.inner(), chart_height},
                   plates ? build_job_chart(history) : build_node_chart(history));
        if (has_second) {
          draw_chart(context, {page.margin, energy_top, page.inner(), energy_height},
                     history.job.words().plates() ? build_energy_chart(history) : build_node_chart(history));
        }
      },
      print);
}

std::string render_wide_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& frames,
                                const PrintSize& print) {
  const std::vector<LatticeStage> stages = lattice_stages(frames, {history.job.case_(), history.samples});
  const Page page(print, kWidth);
  const double left = 0.42 * page.inner();
  const double chart_left = page.margin + left + kChartGap;
  const StagePanels panels = lay_stages(stages, page.margin, page.top, left);
  const double bar_room = page.has_title() ? 0.0 : kColourBarHeight;
  const double height = std::max(panels.bottom - page.top + bar_room, page.chart_height(kChartHeight));
  return render_picture(
      format, page.width, page.top + height + page.margin,
      [&](cairo_t* context) {
        draw_title(context, page, fmt::format("{} ({})", picture_name(history.job), history.job.name()),
                   subtitle_of(history.job), kColourBarRoom);
        if (page.has_title()) {
          draw_plastic_bar(context, page, page.margin + 26.0);
        } else {
          draw_colour_bar(context, page.margin + left, panels.bottom, 0.3 * left, "plastic fraction");
        }
        draw_stages(context, panels, stages);
        draw_chart(context, {chart_left, page.top, page.width - page.margin - chart_left, height},
                   has_strain(history.job.words()) ? build_job_chart(history) : build_node_chart(history));
      },
      print);
}

std::string render_stages_picture(PictureFormat format, const std::vector<MeshFrame>& frames,
                                  const RigidWalls& rigid_walls, const PrintSize& print) {
  const std::vector<LatticeStage> stages = lattice_stages(frames, rigid_walls);
  constexpr double kNarrowMargin = 12.0;
  const Page page(print, kWidth);
  const double top = std::min(page.margin, kNarrowMargin);
  constexpr double kBars = 60.0;
  const double most = std::min(kStagesHeight, page.height - kBars);
  const StagePanels panels = lay_stages(stages, page.margin, top, page.inner(), most);
  return render_picture(
      format, page.width, panels.bottom + kColourBarHeight + top,
      [&](cairo_t* context) {
        draw_stages(context, panels, stages);
        draw_plastic_bar(context, page, panels.bottom);
      },
      print);
}

std::string render_comparison_picture(PictureFormat format, const std::vector<JobHistory>& histories,
                                      const PrintSize& print, const TestOverlay& test) {
  return render_jobs_chart(format, histories.front().job, histories.size(), !test.name.empty(),
                           "plate stress against nominal strain", build_comparison_chart(histories, test), print);
}

std::string render_force_picture(PictureFormat format, const std::vector<v1::Job>& jobs,
                                 const std::vector<v1::CompareTestResponse>& forces, const std::string& subtitle,
                                 const PrintSize& print, const TestOverlay& test) {
  return render_jobs_chart(format, jobs.front(), jobs.size(), true, subtitle, build_force_chart(jobs, forces, test),
                           print);
}

std::string render_sweep_picture(PictureFormat format, const std::vector<SweepResults>& sweeps,
                                 const LogarithmicAxes& logarithmic, bool series, const PrintSize& print) {
  const Page page(print, kSweepWidth);
  const auto map = series || sweeps.size() > 1 ? std::nullopt : build_sweep_map(sweeps.front().table, logarithmic);
  const Chart chart = map ? Chart() : build_sweep_chart(sweeps, logarithmic);
  // A legend of many series takes more lines.
  const double legend = map ? 0.0 : 8.0 * static_cast<double>(chart.curves.size());
  const double chart_height = page.chart_height(kChartHeight + 60.0) + legend;
  const std::string& title = sweeps.front().sweep.case_().title();
  return render_picture(
      format, page.width, page.top + chart_height + page.margin,
      [&](cairo_t* context) {
        if (sweeps.size() > 1) {
          std::string names;
          for (const SweepResults& results : sweeps) names += (names.empty() ? "" : ", ") + results.sweep.name();
          draw_title(context, page, "Plateau stress",
                     fmt::format("{} sweeps over {}   ({})", sweeps.size(), chart.x.label, names));
        } else {
          draw_title(context, page, title.empty() ? "Plateau stress" : title, sweep_subtitle(sweeps.front()));
        }
        const Rectangle place{page.margin, page.top, page.inner(), chart_height};
        map ? draw_sweep_map(context, place, *map) : draw_chart(context, place, chart);
      },
      print);
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
