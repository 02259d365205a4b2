#include "chart/sweep_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "chart/palette.h"
#include "command_error.h"
#include "results/field_value.h"
#include "results/sweep_results.h"

namespace cellcrush::client {

namespace {

constexpr int kCurvePoints = 200;

double impact(const v1::Summary& summary) { return summary.plateau_stress_impact_mpa(); }
double support(const v1::Summary& summary) { return summary.plateau_stress_support_mpa(); }
double shock(const v1::Summary& summary) { return summary.theory().shock_mpa(); }
double quasi_static(const v1::Summary& summary) { return summary.theory().gibson_ashby_mpa(); }

bool has_theory(const ResultSeries& series) {
  return std::all_of(series.summaries.begin(), series.summaries.end(),
                     [](const v1::Summary* summary) { return summary->theory().shock_mpa() > 0.0; });
}

// The axis of the varied field: from 0 where that wastes little room.
Axis build_axis(const std::string& field, const std::vector<ResultSeries>& all) {
  double low = all.front().x.front();
  double high = all.front().x.back();
  for (const ResultSeries& series : all) {
    low = std::min(low, series.x.front());
    high = std::max(high, series.x.back());
  }
  const double room = high > low ? 0.06 * (high - low) : 0.1 * std::max(std::abs(low), 1.0);
  const bool from_zero = low >= 0.0 && low < 0.5 * high;
  return {from_zero ? 0.0 : low - room, high + room, axis_label(field)};
}

Curve sampled(const QuadraticFit& curve, double from, double to, LineStyle style, std::string name) {
  Curve result{{}, {}, std::move(style), std::move(name)};
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double x = from + (to - from) * i / kCurvePoints;
    result.x.push_back(x);
    result.y.push_back(curve.at(x));
  }
  return result;
}

// Three digits; far from 1 with a power of ten: "2.98·10⁻⁴".
std::string digits_text(double value) {
  static constexpr std::array kRaised = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const std::string text = fmt::format("{:.2e}", value);
  const std::size_t mark = text.find('e');
  const int exponent = std::stoi(text.substr(mark + 1));
  if (exponent > -3 && exponent < 4) return fmt::format("{:.3g}", value);
  std::string raised = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) raised += kRaised[static_cast<std::size_t>(digit - '0')];
  return text.substr(0, mark) + "·10" + raised;
}

std::string fit_name(const QuadraticFit& fit) {
  const auto term = [](double value, const char* factor) {
    return fmt::format(" {} {} {}", std::signbit(value) ? "−" : "+", digits_text(std::abs(value)), factor);
  };
  const char* kind = fit.passes_through() ? "quadratic through the points: " : "quadratic fit: ";
  return kind + digits_text(fit.constant) + term(fit.linear, "V") + term(fit.quadratic, "V²");
}

// Theory's two stresses over a series, in muted or in the series' own colour.
void add_theory(Chart& chart, const ResultSeries& series, bool speed, const Colour& colour, bool named) {
  if (!has_theory(series)) return;
  const LineStyle dashed{colour, 1.4, {8.0, 4.0}};
  const LineStyle dotted{colour, 1.4, {2.0, 3.0}};
  const std::string name = named ? "Eq. 51 (shock)" : "";
  if (const auto curve = speed ? find_shock_curve(series) : std::nullopt) {
    chart.curves.push_back(sampled(*curve, chart.x.low, chart.x.high, dashed, name));
    chart.curves.push_back({{chart.x.low, chart.x.high},
                            {curve->constant, curve->constant},
                            dotted,
                            named ? "Gibson-Ashby (quasi-static)" : ""});
    return;
  }
  chart.curves.push_back({series.x, values_of(series, shock), dashed, name});
  chart.curves.push_back(
      {series.x, values_of(series, quasi_static), dotted, named ? "Gibson-Ashby (quasi-static)" : ""});
}

// Eq. 52 at those jobs that have a front.
void add_measured_shock(Chart& chart, const ResultSeries& series, const Colour& colour, const char* name) {
  Curve curve{{}, {}, {colour, 0.0, {}}, name, Marker::cross};
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!series.summaries[i]->has_front()) continue;
    curve.x.push_back(series.x[i]);
    curve.y.push_back(series.summaries[i]->front().shock_mpa());
  }
  if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
}

// The plateau at the impact plate: marks, and as a line the fit where there is one.
void add_impact(Chart& chart, const ResultSeries& series, const std::optional<QuadraticFit>& fit, const Colour& colour,
                const std::string& name) {
  chart.curves.push_back({series.x, values_of(series, impact), {colour, fit ? 0.0 : 1.6, {}}, name, Marker::disc});
}

void add_only_series(Chart& chart, const ResultSeries& series, bool speed) {
  const auto fit = speed ? find_plateau_fit(series) : std::nullopt;
  add_impact(chart, series, fit, kImpactColour, "impact plate");
  chart.curves.push_back(
      {series.x, values_of(series, support), {kSupportColour, 1.2, {}}, "support plate", Marker::square});
  const LineStyle solid{kImpactColour, 1.6, {}};
  if (fit) chart.curves.push_back(sampled(*fit, series.x.front(), series.x.back(), solid, fit_name(*fit)));
  add_theory(chart, series, speed, kMutedInk, true);
  add_measured_shock(chart, series, kInk, "Eq. 52 (shock, jumps measured)");
}

void add_series(Chart& chart, const ResultSeries& series, bool speed, const Colour& colour) {
  const auto fit = speed ? find_plateau_fit(series) : std::nullopt;
  add_impact(chart, series, fit, colour, series.name);
  chart.curves.push_back({series.x, values_of(series, support), {colour, 0.9, {}}, "", Marker::square});
  const LineStyle solid{colour, 1.6, {}};
  if (fit) chart.curves.push_back(sampled(*fit, series.x.front(), series.x.back(), solid, ""));
  Colour faint = colour;
  faint.opacity = 0.55;
  add_theory(chart, series, speed, faint, false);
  add_measured_shock(chart, series, colour, "");
}

double highest(const Chart& chart) {
  double top = 0.0;
  for (const Curve& curve : chart.curves) {
    for (const double value : curve.y) top = std::isfinite(value) ? std::max(top, value) : top;
  }
  return top;
}

}  // namespace

std::string axis_label(const std::string& field) {
  const FieldWords words = words_of(field);
  return words.unit.empty() ? words.name : fmt::format("{} ({})", words.name, words.unit);
}

Chart build_sweep_chart(const v1::SweepTable& table) {
  const auto all = split_series(table);
  if (table.fields_size() == 0 || all.empty()) {
    throw CommandError(ExitCode::refused,
                       "no job of the sweep has succeeded with a plateau yet, so that there is nothing to "
                       "draw; `cellcrush table` says how its jobs stand");
  }
  const bool speed = varies_speed_first(table);
  Chart chart;
  chart.x = build_axis(table.fields(0), all);
  chart.y.label = "plateau stress (MPa)";
  if (all.size() == 1) {
    add_only_series(chart, all.front(), speed);
  } else {
    for (std::size_t i = 0; i < all.size(); ++i)
      add_series(chart, all[i], speed, kSeriesColours[i % kSeriesColours.size()]);
    chart.note = "discs: impact plate; squares: support plate; ";
    if (speed) chart.note += "solid: quadratic fit; ";
    chart.note += "dashed: Eq. 51; crosses: Eq. 52; dotted: Gibson-Ashby";
  }
  const double top = highest(chart);
  chart.y.high = top > 0.0 ? 1.08 * top : 1.0;
  std::size_t drawn = 0;
  for (const ResultSeries& series : all) drawn += series.x.size();
  if (const auto rows = static_cast<std::size_t>(table.rows_size()); drawn < rows) {
    chart.note += fmt::format("{}{} of {} jobs have no plateau", chart.note.empty() ? "" : "; ", rows - drawn, rows);
  }
  return chart;
}

}  // namespace cellcrush::client
