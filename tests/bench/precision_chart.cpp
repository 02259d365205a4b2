#include "bench/precision_chart.h"

#include "bench/picture_file.h"
#include "bench/precision_panel.h"

namespace cellcrush::bench {
namespace {

constexpr double kPanelWidth = 580.0;
constexpr double kPanelHeight = 420.0;
constexpr double kMargin = 14.0;
constexpr double kNoteHeight = 42.0;
constexpr double kOverviewWidth = 720.0;
constexpr double kOverviewHeight = 470.0;
const client::TextStyle kNoteStyle{.size = 11.5, .colour = client::kMutedInk};

PrecisionPanel panel_of(const VariedScene& scene, const std::vector<CsvRow>& rows, const Measure& measure,
                        const std::string& converged) {
  double scatter = 0.0;
  const std::vector<Precision> all = precisions(scene, rows, measure, converged, scatter);
  PrecisionPanel panel;
  panel.title = measure.title;
  panel.series = series_of(all, measure, converged);
  for (const Precision& precision : all) {
    if (!measure.absolute && precision.variant == converged) panel.known_to = 100.0 * precision.uncertainty;
  }
  return panel;
}

void draw_note(cairo_t* context, double y) {
  client::draw_text(context, client::Axes::kLeft + kMargin, y,
                    "Numbers: elements a wall. Bars: 95 % intervals over the seeds of an imperfection.", kNoteStyle);
  client::draw_text(context, client::Axes::kLeft + kMargin, y + 16.0,
                    "Open mark: the interval includes zero error; the mark stands at half of its width.", kNoteStyle);
}

}  // namespace

void draw_precisions(const std::string& file, const VariedScene& scene, const std::vector<CsvRow>& rows,
                     const std::string& converged) {
  std::vector<PrecisionPanel> panels;
  for (const Measure& measure : kMeasures) {
    PrecisionPanel panel = panel_of(scene, rows, measure, converged);
    if (panel.series.empty()) continue;
    panel.title = scene.name + ": " + panel.title;
    panel.error_label = measure.absolute ? "energy not accounted for (%)" : "error (%)";
    fit_axes(panel);
    panels.push_back(std::move(panel));
  }
  constexpr double kLegendTop = 10.0;
  constexpr double kLegendHeight = 56.0;
  const std::size_t lines = (panels.size() + 1) / 2;
  const double width = kMargin + 2.0 * (kPanelWidth + kMargin);
  const double height = kLegendHeight + static_cast<double>(lines) * (kPanelHeight + kMargin) + kNoteHeight;
  write_picture(file, width, height, [&](cairo_t* context) {
    draw_legend(context, kMargin + client::Axes::kLeft, kLegendTop, 330.0, 3, true);
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const std::size_t line = i / 2;
      const double x = kMargin + static_cast<double>(i % 2) * (kPanelWidth + kMargin);
      const double y = kLegendHeight + static_cast<double>(line) * (kPanelHeight + kMargin);
      draw_panel(context, {x, y, kPanelWidth, kPanelHeight}, panels[i]);
    }
    draw_note(context, height - kNoteHeight + 12.0);
  });
}

void draw_overview(const std::string& file, const VariedScene& scene, const std::vector<CsvRow>& rows,
                   const std::string& converged, const std::string& title) {
  PrecisionPanel panel = panel_of(scene, rows, kMeasures.front(), converged);
  panel.title.clear();
  panel.labels_settings = false;
  panel.shows_front = false;
  panel.error_label = "error of the support plateau (%)";
  fit_axes(panel);
  write_picture(file, kOverviewWidth, kOverviewHeight, [&](cairo_t* context) {
    const double left = kMargin + client::Axes::kLeft;
    client::draw_text(context, left, 24.0, title, {.size = 14.5, .bold = true});
    const double legend = draw_legend(context, left, 36.0, 300.0, 2, false);
    const double top = 36.0 + legend + 4.0;
    draw_panel(context, {kMargin, top, kOverviewWidth - 2.0 * kMargin, kOverviewHeight - top - kNoteHeight - 2.0},
               panel);
    draw_note(context, kOverviewHeight - kNoteHeight + 14.0);
  });
}

}  // namespace cellcrush::bench
