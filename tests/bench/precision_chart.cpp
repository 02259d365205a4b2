#include "bench/precision_chart.h"

#include <algorithm>
#include <cmath>

#include "bench/picture_file.h"
#include "chart/chart.h"
#include "chart/palette.h"

namespace cellcrush::bench {
namespace {

using client::Chart;
using client::Curve;
using client::Marker;

constexpr double kPanelWidth = 560.0;
constexpr double kPanelHeight = 430.0;
constexpr double kTitleHeight = 26.0;
constexpr double kMargin = 14.0;
constexpr double kLeastError = 1e-6;

std::string group_of(const std::string& variant) { return variant.substr(0, variant.find(':')); }
std::string label_of(const std::string& variant) { return variant.substr(variant.find(':') + 1); }

/// A curve without line for each group, in the order in which groups first appear.
std::vector<Curve> group_curves(const VariedScene& scene, const std::vector<Precision>& all) {
  std::vector<std::string> groups;
  for (const Variant& variant : scene.variants) {
    const std::string group = group_of(variant.name);
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::size_t colours = client::kSeriesColours.size();
    const Marker marker = i < colours ? Marker::disc : i < 2 * colours ? Marker::square : Marker::cross;
    Curve curve{{}, {}, {client::kSeriesColours[i % colours], 0.0, {}}, groups[i], marker};
    for (const Precision& precision : all) {
      if (group_of(precision.variant) != groups[i]) continue;
      curve.x.push_back(precision.seconds);
      const double error = claimed_error(precision);
      const bool sure = error > precision.uncertainty;
      curve.y.push_back(std::max(error, kLeastError));
      curve.low.push_back(sure ? error - precision.uncertainty : error);
      curve.high.push_back(precision.error + precision.uncertainty);
      curve.labels.push_back(label_of(precision.variant));
    }
    if (curve.x.size() == 1) {  // the legend says it, without a word among the points
      curve.name += " " + curve.labels.front();
      curve.labels.clear();
    }
    if (!curve.x.empty()) curves.push_back(std::move(curve));
  }
  return curves;
}

Curve front_curve(std::vector<Precision> all) {
  std::sort(all.begin(), all.end(),
            [](const Precision& one, const Precision& other) { return one.seconds < other.seconds; });
  Curve curve{{}, {}, {client::kInk, 1.2, {}}, "front", Marker::none};
  for (const Precision& precision : all) {
    if (!precision.on_front) continue;
    curve.x.push_back(precision.seconds);
    curve.y.push_back(std::max(claimed_error(precision), kLeastError));
  }
  return curve;
}

Chart build_chart(const VariedScene& scene, const std::vector<Precision>& all, double scatter) {
  const auto [fastest, slowest] = std::minmax_element(
      all.begin(), all.end(), [](const Precision& one, const Precision& other) { return one.seconds < other.seconds; });
  Chart chart;
  chart.x = {0.7 * fastest->seconds, 2.0 * slowest->seconds, "processor time of a crush (s)", true};
  chart.curves = group_curves(scene, all);
  chart.curves.push_back(front_curve(all));
  double low = 1.0;
  double high = kLeastError;
  for (const Precision& precision : all) {
    low = std::min(low, std::max(claimed_error(precision), kLeastError));
    high = std::max(high, precision.error + precision.uncertainty);
  }
  if (scatter > 0.0) {
    chart.curves.push_back(client::level_curve(scatter, chart.x.low, chart.x.high, {client::kMutedInk, 1.2, {6.0, 4.0}},
                                               "scatter of one converged crush"));
    low = std::min(low, scatter);
    high = std::max(high, scatter);
  }
  chart.y = {0.5 * low, 1.6 * high, "relative error", true};
  chart.note = "bars: 95 % intervals of the mean over the seeds; an error inside is drawn at its end";
  return chart;
}

}  // namespace

void draw_precisions(const std::string& file, const VariedScene& scene, const std::vector<CsvRow>& rows,
                     const std::string& converged) {
  struct Panel {
    std::string title;
    Chart chart;
  };
  std::vector<Panel> panels;
  for (const Measure& measure : kMeasures) {
    double scatter = 0.0;
    const std::vector<Precision> all = precisions(scene, rows, measure, converged, scatter);
    if (!all.empty()) panels.push_back({measure.title, build_chart(scene, all, scatter)});
  }
  const std::size_t columns = std::min<std::size_t>(2, panels.size());
  const std::size_t lines = (panels.size() + 1) / 2;
  const double width = kMargin + static_cast<double>(columns) * (kPanelWidth + kMargin);
  const double height = kMargin + static_cast<double>(lines) * (kPanelHeight + kMargin);
  write_picture(file, width, height, [&](cairo_t* context) {
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const std::size_t column = i % 2;
      const std::size_t line = i / 2;
      const double x = kMargin + static_cast<double>(column) * (kPanelWidth + kMargin);
      const double y = kMargin + static_cast<double>(line) * (kPanelHeight + kMargin);
      client::draw_text(context, x + client::Axes::kLeft, y + 14.0, scene.name + ": " + panels[i].title,
                        {.size = 14.0, .bold = true});
      client::draw_chart(context, {x, y + kTitleHeight, kPanelWidth, kPanelHeight - kTitleHeight}, panels[i].chart);
    }
  });
}

}  // namespace cellcrush::bench
