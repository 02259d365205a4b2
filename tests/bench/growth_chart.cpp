#include "bench/growth_chart.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "bench/picture_file.h"
#include "chart/chart.h"
#include "chart/palette.h"

namespace cellcrush::bench {
namespace {

using client::Chart;
using client::Curve;
using client::Marker;

constexpr double kWidth = 820.0;
constexpr double kHeight = 330.0;
constexpr double kMargin = 12.0;
constexpr double kMostTimesTheTime = 1.5;
constexpr double kMostBytes = 600.0;
const client::LineStyle kBound{client::kMutedInk, 1.2, {6.0, 4.0}};

Curve curve_of(const std::vector<Measured>& measured, const std::vector<std::pair<const char*, double>>& terms,
               std::string name, int colour) {
  Curve curve{{}, {}, {client::kSeriesColours[colour], 1.6, {}}, std::move(name), Marker::disc};
  for (const Measured& row : measured) {
    double sum = 0.0;
    for (const auto& [counter, factor] : terms) sum += factor * row.counters.at(counter);
    curve.x.push_back(row.counters.at("elements"));
    curve.y.push_back(sum);
  }
  return curve;
}

Chart build_chart(std::vector<Curve> curves, const std::string& label) {
  Chart chart;
  chart.x = {0.7 * curves.front().x.front(), 1.5 * curves.front().x.back(), "elements", true};
  chart.y.label = label;
  chart.curves = std::move(curves);
  return chart;
}

void leave_room(Chart& chart) {
  for (const Curve& curve : chart.curves) {
    chart.y.high = std::max(chart.y.high, 1.12 * *std::max_element(curve.y.begin(), curve.y.end()));
  }
}

Chart time_chart(const std::vector<Measured>& measured) {
  Chart chart = build_chart(
      {curve_of(measured, {{"element_step_ns", 1.0}}, "all in", 0),
       curve_of(measured, {{"integrate_motion_ns", 1.0}, {"evaluate_internal_forces_ns", 1.0}}, "walls and motion", 1),
       curve_of(measured, {{"find_contacts_ns", 1.0}, {"evaluate_contact_forces_ns", 1.0}}, "contacts", 2)},
      "time an element-step (ns)");
  chart.curves.push_back(client::level_curve(kMostTimesTheTime * chart.curves.front().y.front(), chart.x.low,
                                             chart.x.high, kBound, "1.5 times the smallest"));
  leave_room(chart);
  return chart;
}

Chart memory_chart(const std::vector<Measured>& measured) {
  Chart chart = build_chart(
      {curve_of(measured, {{"bytes_an_element", 1.0}}, "most resident", 0),
       curve_of(measured, {{"scene_array_bytes_an_element", 1.0}, {"state_array_bytes_an_element", 1.0}}, "arrays", 3)},
      "memory (bytes an element)");
  chart.curves.push_back(client::level_curve(kMostBytes, chart.x.low, chart.x.high, kBound, "600 bytes"));
  leave_room(chart);
  return chart;
}

}  // namespace

void draw_growth(const std::string& file, const std::vector<Measured>& measured) {
  std::vector<Measured> cells;
  std::copy_if(measured.begin(), measured.end(), std::back_inserter(cells),
               [](const Measured& row) { return row.benchmark.starts_with("cells/"); });
  if (cells.size() < 2) {
    throw std::invalid_argument("--chart=" + file +
                                ": takes two benchmarks named cells/... at least; let the filter pass them.");
  }
  write_picture(file, kWidth, kHeight, [&](cairo_t* context) {
    const double half = 0.5 * (kWidth - 3.0 * kMargin);
    client::draw_chart(context, {kMargin, kMargin, half, kHeight - kMargin}, time_chart(cells));
    client::draw_chart(context, {2.0 * kMargin + half, kMargin, half, kHeight - kMargin}, memory_chart(cells));
  });
}

}  // namespace cellcrush::bench
