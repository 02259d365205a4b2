#include "plots/job_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "chart/colour_map.h"
#include "chart/smoothing.h"
#include "results/energy_terms.h"
#include "results/field_value.h"
#include "results/sweep_results.h"
#include "terminal/case_text.h"
#include "terminal/number_text.h"

namespace cellcrush::client {
namespace {

// Of the terms in turn; once all are used they come again, dashed. Plastic work, the first, is red.
LineStyle style_of(std::size_t term) {
  constexpr std::array<std::size_t, 6> kColours = {1, 0, 2, 3, 4, 5};
  static_assert(kColours.size() == kSeriesColours.size());
  const bool again = term >= kColours.size();
  return {kSeriesColours[kColours[term % kColours.size()]], 1.8, again ? std::vector{6.0, 3.0} : std::vector<double>{}};
}

constexpr double kSmoothingWindow = 0.02;
struct PlateCurves {
  std::vector<double> strain;
  std::vector<double> impact;
  std::vector<double> support;
};

PlateCurves curves_of(const JobHistory& history) {
  PlateCurves curves;
  for (const v1::Sample& sample : history.samples) {
    if (!std::isfinite(sample.strain() + sample.stress_impact_mpa() + sample.stress_support_mpa())) continue;
    // A mass between rigid walls rebounds.
    if (!curves.strain.empty() && sample.strain() <= curves.strain.back()) continue;
    curves.strain.push_back(sample.strain());
    curves.impact.push_back(sample.stress_impact_mpa());
    curves.support.push_back(sample.stress_support_mpa());
  }
  return curves;
}

PlateCurves smoothed(const PlateCurves& raw) {
  return {raw.strain, running_mean(raw.strain, raw.impact, kSmoothingWindow),
          running_mean(raw.strain, raw.support, kSmoothingWindow)};
}

double last_strain(const PlateCurves& curves) { return curves.strain.empty() ? 0.0 : curves.strain.back(); }

// The upper end of the stress axis. It follows the plateau: neither the first wave, which is far higher in a fast
// crush, nor the stress after a lasting rise.
double find_top(const JobHistory& history, const PlateCurves& smooth) {
  constexpr double kFirstWave = 0.1;
  const v1::Summary& summary = history.job.summary();
  const double solid = std::min(summary.has_densification_strain() ? summary.densification_strain()
                                : summary.has_other_rise_strain()  ? summary.other_rise_strain()
                                                                   : 0.65,
                                summary.has_valid_to_strain() ? summary.valid_to_strain() : 1.0);
  std::vector<double> crushing;
  for (std::size_t i = 0; i < smooth.strain.size(); ++i) {
    const bool first_wave = smooth.strain[i] < kFirstWave && last_strain(smooth) > 2.0 * kFirstWave;
    if (smooth.strain[i] <= solid && !first_wave) crushing.push_back(std::max(smooth.impact[i], smooth.support[i]));
  }
  double top = crushing.empty() ? 0.0 : 1.3 * quantile(crushing, 0.95);
  if (history.job.words().theory_note().empty()) top = std::max(top, 1.2 * summary.theory().shock_mpa());
  top = std::max({top, 1.6 * summary.plateau_stress_impact_mpa(), 1.6 * summary.plateau_stress_support_mpa()});
  return top > 0.0 ? top : 1.0;
}

// A stress in the unit of the axis, whose upper end is in MPa.
std::string stress_text(const Chart& chart, double stress, int digits = 3) {
  const ShownUnit unit = unit_by_size("MPa", chart.y.high);
  return number_text(unit.factor * stress, digits) + ' ' + unit.name;
}

// Shows a finished chart of stresses in the unit of its size.
void show_stress(Chart& chart) {
  const ShownUnit unit = unit_by_size("MPa", chart.y.high);
  chart.y.label = fmt::format("nominal stress ({})", unit.name);
  scale_y(chart, unit.factor);
}

// Where the result depends on the mesh.
void add_closed_band(Chart& chart, const v1::Summary& summary, double end) {
  if (summary.has_valid_to_strain() && end > summary.valid_to_strain())
    chart.bands.push_back({summary.valid_to_strain(), end, "closed"});
}

// Densification or another lasting rise, and the first of each kind of warning that puts the result in doubt.
void add_marks(Chart& chart, const v1::Summary& summary, const Colour& colour) {
  if (summary.has_densification_strain()) {
    const double strain = summary.densification_strain();
    chart.marks.push_back({strain, "densification " + number_text(strain, 2), colour});
  } else if (summary.has_other_rise_strain()) {
    const double strain = summary.other_rise_strain();
    chart.marks.push_back({strain, summary.other_rise_words() + " " + number_text(strain, 2), colour});
  }
  for (const v1::Warning& warning : summary.warnings()) {
    // Borders cost time only; a chart of one job has a band where it is closed.
    if (warning.kind() == v1::Warning::BORDERS_NEAR || warning.kind() == v1::Warning::CLOSED) continue;
    if (warning.strain() <= 0.0) continue;
    std::string kind = v1::Warning::Kind_Name(warning.kind());
    std::ranges::transform(kind, kind.begin(), [](unsigned char letter) {
      return letter == '_' ? ' ' : static_cast<char>(std::tolower(letter));
    });
    chart.marks.push_back({warning.strain(), "in doubt: " + kind, colour});
  }
}

// An arrow where the smoothed stress of a plate most exceeds the chart.
void add_overshoot(Chart& chart, const std::vector<double>& strain, const std::vector<double>& stress, Colour colour) {
  const auto peak = std::max_element(stress.begin(), stress.end());
  if (peak == stress.end() || *peak <= 1.001 * chart.y.high) return;
  chart.overshoots.push_back(
      {strain[static_cast<std::size_t>(peak - stress.begin())], stress_text(chart, *peak, 2), colour});
}

double highest(const PlateCurves& curves) {
  double value = 0.0;
  for (const double stress : curves.impact) value = std::max(value, stress);
  for (const double stress : curves.support) value = std::max(value, stress);
  return value;
}

Chart empty_chart(double strain, double top, double peak) {
  Chart chart;
  chart.x = {0.0, std::max(strain, 0.01), "nominal strain"};
  chart.y = {0.0, top, {}};
  chart.note = fmt::format("moving mean over {:.0f} % strain", 100 * kSmoothingWindow);
  if (peak > 1.001 * top)
    chart.note += fmt::format("; single samples reach {}, off the chart", stress_text(chart, peak, 2));
  return chart;
}

std::string with_plateau(const Chart& chart, const char* plate, bool known, double stress) {
  return known ? fmt::format("{}: plateau {}", plate, stress_text(chart, stress)) : plate;
}

std::string theory_name(const char* theory, double stress, const Chart& chart) {
  return fmt::format("{}: {}{}", theory, stress_text(chart, stress), stress > chart.y.high ? ", beyond the chart" : "");
}

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

std::string with_speed(const v1::Job& job, const std::string& title) {
  std::string name = title.empty() ? job.name() : title;
  const v1::Loading& loading = job.case_().loading();
  if (!loading.has_speed_m_per_s() && !loading.quasi_static()) return name;
  const std::string speed = loading.quasi_static() ? "quasi-static" : short_text(loading.speed_m_per_s()) + " m/s";
  return name.find(speed) == std::string::npos ? name + ", " + speed : name;
}

void add_test(const TestOverlay& test, Chart& chart) {
  if (test.name.empty()) return;
  for (const auto& edge : {test.least, test.most}) {
    if (!edge.empty()) chart.curves.push_back({test.x, edge, {kMutedInk, 0.8, {}}, ""});
  }
  chart.curves.push_back({test.x, test.mean, {kInk, 2.0, {}}, test.name});
}

// Without the values that a sweep has appended to the title: what differs stands behind the name.
std::string comparison_name(const v1::Job& job) { return with_speed(job, base_title(job.case_().title())); }

}  // namespace

Chart build_energy_chart(const JobHistory& history) {
  Chart chart;
  double low = 0.0;
  double high = 0.0;
  double strain = 0.0;
  const auto add = [&](const std::string& name, const LineStyle& style, bool even_if_zero, const auto& energy) {
    Curve curve{{}, {}, style, name};
    bool any = even_if_zero;
    for (const v1::Sample& sample : history.samples) {
      const double value = energy(sample);
      if (!std::isfinite(sample.strain() + value)) continue;
      curve.x.push_back(sample.strain());
      curve.y.push_back(value);
      any = any || value != 0.0;
      low = std::min(low, value);
      high = std::max(high, value);
      strain = std::max(strain, sample.strain());
    }
    if (any) chart.curves.push_back(std::move(curve));
  };
  add("work of the plates", {kInk, 2.0, {}}, false, [](const v1::Sample& sample) { return sample.work_external_mj(); });
  std::size_t number = 0;
  for (const EnergyTerm& term : energy_terms_of(*v1::Sample::descriptor()))
    add(term.label, style_of(number++), false, [&](const v1::Sample& sample) { return term.value(sample); });
  add("residual", {kMutedInk, 1.4, {2.0, 3.0}}, true,
      [](const v1::Sample& sample) { return sample.energy_residual_mj(); });
  chart.x = {0.0, std::max(strain, 0.01), "nominal strain"};
  const double room = high > low ? 0.06 * (high - low) : 1.0;
  const ShownUnit unit = unit_by_size("mJ", high);
  chart.y = {low < 0.0 ? low - room : 0.0, high + room, fmt::format("energy ({})", unit.name)};
  scale_y(chart, unit.factor);
  add_closed_band(chart, history.job.summary(), strain);
  chart.note = "totals since the start; the work equals the sum of the other curves";
  return chart;
}

std::string picture_name(const v1::Job& job) { return with_speed(job, job.case_().title()); }

Chart build_job_chart(const JobHistory& history) {
  const PlateCurves raw = curves_of(history);
  const PlateCurves smooth = smoothed(raw);
  const v1::Summary& summary = history.job.summary();
  Chart chart = empty_chart(last_strain(raw), find_top(history, smooth), highest(raw));
  chart.note += "; thin: every sample";
  struct Plate {
    const char* name;
    const std::vector<double>& raw;
    const std::vector<double>& smooth;
    Colour colour;
    bool has_plateau;
    double plateau;
  };
  std::vector<Plate> plates = {{"impact plate", raw.impact, smooth.impact, kImpactColour,
                                summary.has_plateau_stress_impact_mpa(), summary.plateau_stress_impact_mpa()},
                               {"support plate", raw.support, smooth.support, kSupportColour,
                                summary.has_plateau_stress_support_mpa(), summary.plateau_stress_support_mpa()}};
  if (!has_support(history.job)) plates.pop_back();
  for (const Plate& plate : plates) {
    Colour faint = plate.colour;
    faint.opacity = 0.28;
    chart.curves.push_back({raw.strain, plate.raw, {faint, 0.7, {}}, ""});
  }
  for (const Plate& plate : plates) {
    chart.curves.push_back({smooth.strain,
                            plate.smooth,
                            {plate.colour, 2.0, {}},
                            with_plateau(chart, plate.name, plate.has_plateau, plate.plateau)});
    add_overshoot(chart, smooth.strain, plate.smooth, plate.colour);
  }
  const double low = summary.plateau_window_low();
  const double high = summary.plateau_window_high();
  if (high > low) {
    chart.bands.push_back({low, high, "plateau window"});
    for (const Plate& plate : plates) {
      if (plate.has_plateau) chart.curves.push_back(level_curve(plate.plateau, low, high, {kInk, 1.8, {}}, ""));
    }
  }
  add_closed_band(chart, summary, last_strain(smooth));
  if (summary.theory().shock_mpa() > 0.0) {
    const auto add_theory = [&](const char* name, double stress, std::vector<double> dashes) {
      chart.curves.push_back(level_curve(stress, 0.0, chart.x.high, {kMutedInk, 1.4, std::move(dashes)},
                                         theory_name(name, stress, chart)));
    };
    add_theory("shock theory (Eq. 51)", summary.theory().shock_mpa(), {8.0, 4.0});
    if (summary.has_front())
      add_theory("shock theory, measured jumps (Eq. 52)", summary.front().shock_mpa(), {10.0, 3.0, 2.0, 3.0});
    add_theory("quasi-static theory (Gibson-Ashby)", summary.theory().gibson_ashby_mpa(), {2.0, 3.0});
  }
  if (const std::string absent = absent_theory_text(summary); !absent.empty()) chart.note += "; " + absent;
  add_marks(chart, summary, kMutedInk);
  show_stress(chart);
  return chart;
}

Chart build_comparison_chart(const std::vector<JobHistory>& histories, const TestOverlay& test) {
  std::map<std::string, std::vector<const v1::Case*>> cases;  // of each name
  for (const JobHistory& history : histories) cases[comparison_name(history.job)].push_back(&history.job.case_());
  std::vector<Curve> curves;
  double strain = 0.0;
  double top = 0.0;
  double peak = 0.0;
  for (std::size_t i = 0; i < histories.size(); ++i) {
    const v1::Job& job = histories[i].job;
    const PlateCurves raw = curves_of(histories[i]);
    const PlateCurves smooth = smoothed(raw);
    const Colour colour = kSeriesColours[i % kSeriesColours.size()];
    std::string name = comparison_name(job);
    if (const auto& same = cases.at(name); same.size() > 1) {
      const std::string values = field_values_text(job.case_(), find_differences(same));
      name += (values.empty() ? "" : ", " + values) + " (" + job.name() + ")";
    }
    curves.push_back({smooth.strain, smooth.impact, {colour, 2.0, {}}, name});
    LineStyle dashed{colour, 1.4, {}};
    dashed.dashes = {5.0, 3.0};
    curves.push_back({smooth.strain, smooth.support, dashed, ""});
    strain = std::max(strain, last_strain(smooth));
    top = std::max(top, find_top(histories[i], smooth));
    peak = std::max(peak, highest(raw));
  }
  for (const double stress : test.mean) top = std::max(top, 1.05 * stress);
  Chart chart = empty_chart(strain, top, peak);
  for (const Curve& curve : curves) add_overshoot(chart, curve.x, curve.y, curve.style.colour);
  chart.note += "; solid: impact plate, dashed: support plate";
  chart.curves = std::move(curves);
  for (std::size_t i = 0; i < histories.size(); ++i) {
    const v1::Summary& summary = histories[i].job.summary();
    if (summary.has_plateau_stress_impact_mpa()) {
      chart.curves[2 * i].name += ": plateau " + stress_text(chart, summary.plateau_stress_impact_mpa());
    }
    add_marks(chart, summary, kSeriesColours[i % kSeriesColours.size()]);
    if (summary.has_valid_to_strain() && summary.valid_to_strain() < last_strain(curves_of(histories[i])))
      chart.marks.push_back({summary.valid_to_strain(), "closed", kSeriesColours[i % kSeriesColours.size()]});
  }
  add_test(test, chart);
  show_stress(chart);
  return chart;
}

Chart build_force_chart(const std::vector<v1::Job>& jobs, const std::vector<v1::CompareTestResponse>& forces,
                        const TestOverlay& test) {
  Chart chart;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const auto& force = forces[i];
    add_curve(chart, {force.x().begin(), force.x().end()}, {force.computed_y().begin(), force.computed_y().end()},
              comparison_name(jobs[i]));
  }
  add_test(test, chart);
  fit_axes(chart);
  chart.x.label = "displacement (mm)";
  const ShownUnit unit = unit_by_size("N", std::max(chart.y.high, -chart.y.low));
  chart.y.label = fmt::format("force ({})", unit.name);
  scale_y(chart, unit.factor);
  return chart;
}

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
    add_energy(chart, history, &v1::Sample::work_external_mj, "work of loads");
    fit_axes(chart);
    const ShownUnit unit = unit_by_size("mJ", chart.y.high);
    chart.y.label = fmt::format("energy ({})", unit.name);
    scale_y(chart, unit.factor);
    return chart;
  }
  fit_axes(chart);
  if (const v1::Summary& summary = history.job.summary(); summary.has_valid_to_time_s())
    chart.bands.push_back({1e3 * summary.valid_to_time_s(), chart.x.high, "closed"});
  return chart;
}

}  // namespace cellcrush::client
