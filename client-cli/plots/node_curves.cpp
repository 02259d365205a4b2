#include <algorithm>
#include <cmath>
#include <utility>

#include "chart/colour_map.h"
#include "plots/job_curves.h"

namespace cellcrush::client {

namespace {

// A curve in its own colour, dashed once all colours are used.
void add_curve(Chart& chart, std::vector<double> x, std::vector<double> y, std::string name) {
  const std::size_t index = chart.curves.size();
  std::vector<double> dashes;
  if (index >= kSeriesColours.size()) dashes = {6.0, 3.0};
  chart.curves.push_back(
      {std::move(x), std::move(y), {kSeriesColours[index % kSeriesColours.size()], 1.8, dashes}, std::move(name)});
}

std::vector<double> times_of(const JobHistory& history) {
  std::vector<double> times;
  for (const v1::Sample& sample : history.samples) times.push_back(1e3 * sample.time_s());
  return times;
}

void add_motion(Chart& chart, const JobHistory& history, double (v1::WatchedNode::*value)() const, const char* name) {
  int watched = 0;
  for (const v1::Sample& sample : history.samples) watched = std::max(watched, sample.watched_size());
  for (int node = 0; node < watched; ++node) {
    std::vector<double> x;
    std::vector<double> y;
    std::string id;
    for (const v1::Sample& sample : history.samples) {
      if (node >= sample.watched_size()) continue;
      id = sample.watched(node).node();
      x.push_back(1e3 * sample.time_s());
      y.push_back((sample.watched(node).*value)());
    }
    if (std::any_of(y.begin(), y.end(), [](double moved) { return moved != 0.0; })) {
      add_curve(chart, std::move(x), std::move(y), name + (" of " + id));
    }
  }
}

void add_energy(Chart& chart, const JobHistory& history, double (v1::Sample::*value)() const, const char* name) {
  std::vector<double> y;
  for (const v1::Sample& sample : history.samples) y.push_back((sample.*value)());
  add_curve(chart, times_of(history), std::move(y), name);
}

// Fits an axis to the data, including 0.
void fit_axes(Chart& chart) {
  double low = 0.0;
  double high = 0.0;
  double end = 0.0;
  for (const Curve& curve : chart.curves) {
    for (const double value : curve.y) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    for (const double time : curve.x) end = std::isfinite(time) ? std::max(end, time) : end;
  }
  const double room = high > low ? 0.06 * (high - low) : 1.0;
  chart.y.low = low < 0.0 ? low - room : 0.0;
  chart.y.high = high + room;
  chart.x = {0.0, end > 0.0 ? end : 1.0, "time (ms)"};
}

}  // namespace

Chart build_node_chart(const JobHistory& history) {
  Chart chart;
  add_motion(chart, history, &v1::WatchedNode::ux_mm, "x");
  add_motion(chart, history, &v1::WatchedNode::uy_mm, "y");
  chart.y.label = "displacement (mm)";
  if (chart.curves.empty()) {
    add_motion(chart, history, &v1::WatchedNode::rotation_rad, "rotation");
    chart.y.label = "rotation (rad)";
  }
  if (chart.curves.empty()) {
    add_energy(chart, history, &v1::Sample::energy_kinetic_mj, "kinetic");
    add_energy(chart, history, &v1::Sample::energy_elastic_mj, "elastic");
    add_energy(chart, history, &v1::Sample::energy_plastic_mj, "plastic");
    add_energy(chart, history, &v1::Sample::work_external_mj, "work done on the frame");
    chart.y.label = "energy (mJ)";
  }
  fit_axes(chart);
  return chart;
}

}  // namespace cellcrush::client
