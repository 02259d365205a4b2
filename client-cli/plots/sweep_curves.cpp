#include "plots/sweep_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "chart/colour_map.h"
#include "command_error.h"
#include "results/field_value.h"
#include "results/sweep_results.h"
#include "terminal/number_text.h"

namespace cellcrush::client {

namespace {

constexpr int kCurvePoints = 200;

constexpr const char* kImpactPath = "plateau_stress_impact_mpa";
constexpr const char* kSupportPath = "plateau_stress_support_mpa";
constexpr const char* kDensified = "d";
constexpr const char* kWarned = "!";

double impact(const v1::Summary& summary) { return summary.plateau_stress_impact_mpa(); }
double support(const v1::Summary& summary) { return summary.plateau_stress_support_mpa(); }
double shock(const v1::Summary& summary) { return summary.theory().shock_mpa(); }
double quasi_static(const v1::Summary& summary) { return summary.theory().gibson_ashby_mpa(); }

bool has_theory(const ResultSeries& series) {
  return std::all_of(series.summaries.begin(), series.summaries.end(),
                     [](const v1::Summary* summary) { return summary->theory().shock_mpa() > 0.0; });
}

// The axis of the varied field; starts at 0 if that wastes little room.
Axis build_axis(const std::string& field, const std::vector<ResultSeries>& all, bool logarithmic) {
  double low = all.front().x.front();
  double high = all.front().x.back();
  for (const ResultSeries& series : all) {
    low = std::min(low, series.x.front());
    high = std::max(high, series.x.back());
  }
  if (logarithmic) {
    if (low <= 0.0) {
      refuse(field + " has values that are not above 0, which --log x requires; leave --log x out");
    }
    return {low / 1.2, 1.2 * high, axis_label(field), true};
  }
  const double room = high > low ? 0.06 * (high - low) : low != 0.0 ? 0.1 * std::abs(low) : 1.0;
  const bool from_zero = low == 0.0 || (low > 0.0 && low < 0.5 * high);
  return {from_zero ? 0.0 : low - room, high + room, axis_label(field)};
}

Curve sampled(const QuadraticFit& curve, double from, double to, bool logarithmic, LineStyle style, std::string name) {
  Curve result{{}, {}, std::move(style), std::move(name)};
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double share = static_cast<double>(i) / kCurvePoints;
    const double x = logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
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

// Theory's two stresses over a series, in muted colours or the series' own.
void add_theory(Chart& chart, const ResultSeries& series, bool speed, const Colour& colour, bool named) {
  if (!has_theory(series)) return;
  const LineStyle dashed{colour, 1.4, {8.0, 4.0}};
  const LineStyle dotted{colour, 1.4, {2.0, 3.0}};
  const std::string name = named ? "shock theory (Eq. 51)" : "";
  if (const auto curve = speed ? find_shock_curve(series) : std::nullopt) {
    chart.curves.push_back(sampled(*curve, chart.x.low, chart.x.high, chart.x.logarithmic, dashed, name));
    chart.curves.push_back({{chart.x.low, chart.x.high},
                            {curve->constant, curve->constant},
                            dotted,
                            named ? "quasi-static theory (Gibson-Ashby)" : ""});
    return;
  }
  chart.curves.push_back({series.x, values_of(series, shock), dashed, name});
  chart.curves.push_back(
      {series.x, values_of(series, quasi_static), dotted, named ? "quasi-static theory (Gibson-Ashby)" : ""});
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

// A curve of means with error bars of their 95 % intervals; without bars where the rows are single jobs.
void add_intervals(Curve& curve, const ResultSeries& series, const char* path) {
  for (std::size_t i = 0; i < series.means.size(); ++i) {
    const double interval = find_interval(*series.means[i], path).value_or(0.0);
    curve.low.push_back(curve.y[i] - interval);
    curve.high.push_back(curve.y[i] + interval);
  }
}

// Marks points whose plateau window reaches into densification, and those with warnings.
void add_doubts(Curve& curve, const ResultSeries& series) {
  bool any = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const v1::Summary& summary = *series.summaries[i];
    const bool densified =
        summary.has_densification_strain() && summary.densification_strain() < summary.plateau_window_high();
    const bool warned = series.means.empty() ? summary.warnings_size() > 0 : series.means[i]->warned_count() > 0;
    curve.labels.push_back(std::string(densified ? kDensified : "") + (warned ? kWarned : ""));
    any = any || densified || warned;
  }
  if (!any) curve.labels.clear();
}

// The plateaus of one series of a sweep with theory: named and in the colours of the plates if it is the only one.
void add_series(Chart& chart, const ResultSeries& series, bool speed, bool is_only, const Colour& colour,
                const ShownUnit& unit) {
  const auto fit = speed ? find_plateau_fit(series) : std::nullopt;
  const Colour impact_colour = is_only ? kImpactColour : colour;
  Curve& at_impact = chart.curves.emplace_back(Curve{series.x,
                                                     values_of(series, impact),
                                                     {impact_colour, fit ? 0.0 : 1.6, {}},
                                                     is_only ? "impact plate" : series.name,
                                                     Marker::disc});
  add_intervals(at_impact, series, kImpactPath);
  add_doubts(at_impact, series);
  Curve& at_support = chart.curves.emplace_back(Curve{series.x,
                                                      values_of(series, support),
                                                      {is_only ? kSupportColour : colour, is_only ? 1.2 : 0.9, {}},
                                                      is_only ? "support plate" : "",
                                                      Marker::square});
  add_intervals(at_support, series, kSupportPath);
  if (fit) {
    chart.curves.push_back(sampled(*fit, series.x.front(), series.x.back(), chart.x.logarithmic,
                                   {impact_colour, 1.6, {}}, is_only ? fit_name(scaled(*fit, unit.factor)) : ""));
  }
  Colour faint = colour;
  faint.opacity = 0.55;
  add_theory(chart, series, speed, is_only ? kMutedInk : faint, is_only);
  add_measured_shock(chart, series, is_only ? kInk : colour, is_only ? "shock theory, measured jumps (Eq. 52)" : "");
}

// The plateau of one of several sweeps, with its own mark and colour; shock theory dashed.
void add_sweep(Chart& chart, const ResultSeries& series, bool speed, std::size_t index) {
  const Colour colour = kSeriesColours[index % kSeriesColours.size()];
  const Marker marker = kSeriesMarkers[index % kSeriesMarkers.size()];
  Curve& plateau =
      chart.curves.emplace_back(Curve{series.x, values_of(series, impact), {colour, 1.6, {}}, series.name, marker});
  add_intervals(plateau, series, kImpactPath);
  add_doubts(plateau, series);
  if (!has_theory(series)) return;
  Colour faint = colour;
  faint.opacity = 0.55;
  const LineStyle dashed{faint, 1.4, {8.0, 4.0}};
  const auto curve = speed ? find_shock_curve(series) : std::nullopt;
  chart.curves.push_back(curve ? sampled(*curve, chart.x.low, chart.x.high, chart.x.logarithmic, dashed, "")
                               : Curve{series.x, values_of(series, shock), dashed, ""});
}

std::set<std::string> varied_fields(const SweepResults& results) {
  std::set<std::string> fields(results.table.fields().begin(), results.table.fields().end());
  for (const v1::SweepAxis& axis : results.sweep.axes()) fields.insert(axis.field());
  return fields;
}

// What tells a sweep from the others: its title, unless all have the same, and its values of the fields in which sweeps
// of this title differ, except those that it varies.
std::string name_among(const SweepResults& results, const std::vector<SweepResults>& sweeps) {
  const std::string& title = results.sweep.case_().title();
  std::vector<const v1::Case*> cases;
  std::set<std::string> varied;
  for (const SweepResults& other : sweeps) {
    if (other.sweep.case_().title() != title) continue;
    cases.push_back(&other.sweep.case_());
    varied.merge(varied_fields(other));
  }
  std::vector<std::string> fields = find_differences(cases);
  for (const std::string& field : varied) {
    if (field != kSeedField && std::ranges::find(fields, field) == fields.end()) fields.push_back(field);
  }
  std::erase_if(fields, [own = varied_fields(results)](const std::string& field) { return own.contains(field); });
  const std::string values = field_values_text(results.sweep.case_(), fields);
  if (cases.size() == sweeps.size() || title.empty()) return values;
  return title + (values.empty() ? "" : ", " + values);
}

// All series of the sweeps; those of several sweeps with what tells the sweep from the others, or else its name.
std::vector<ResultSeries> collect_series(const std::vector<SweepResults>& sweeps) {
  std::vector<ResultSeries> all;
  std::vector<const std::string*> names;  // of the sweep of each
  std::map<std::string, int> uses;
  const auto append = [](std::string& text, const std::string& more) {
    text += (text.empty() || more.empty() ? "" : ", ") + more;
  };
  for (const SweepResults& results : sweeps) {
    for (ResultSeries& series : split_series(results.table)) {
      if (sweeps.size() > 1) {
        std::string name = name_among(results, sweeps);
        append(name, series.name);
        series.name = name;
      }
      ++uses[series.name];
      names.push_back(&results.sweep.name());
      all.push_back(std::move(series));
    }
  }
  for (std::size_t i = 0; sweeps.size() > 1 && i < all.size(); ++i) {
    if (!all[i].name.empty() && uses[all[i].name] == 1) continue;
    std::string name = *names[i];
    append(name, all[i].name);
    all[i].name = name;
  }
  return all;
}

// The y axis: from 0, or logarithmic from below the lowest value above 0.
void fit_stress_axis(Chart& chart, bool logarithmic) {
  double low = std::numeric_limits<double>::max();
  double high = 0.0;
  for (const Curve& curve : chart.curves) {
    for (const double value : curve.y) {
      if (!std::isfinite(value)) continue;
      high = std::max(high, value);
      if (value > 0.0) low = std::min(low, value);
    }
  }
  chart.y.logarithmic = logarithmic && high > 0.0;
  chart.y.low = chart.y.logarithmic ? low / 1.3 : 0.0;
  chart.y.high = high > 0.0 ? (chart.y.logarithmic ? 1.3 : 1.08) * high : 1.0;
}

void add_note(Chart& chart, const std::string& sentence) { chart.note += (chart.note.empty() ? "" : "; ") + sentence; }

// What bars, letters and absent theories mean, where there are any.
void add_notes(Chart& chart, const std::vector<ResultSeries>& all) {
  std::string labels;
  for (const Curve& curve : chart.curves) {
    for (const std::string& label : curve.labels) labels += label;
  }
  std::size_t points = 0;
  std::map<std::string, std::size_t> absent;
  bool has_means = false;
  for (const ResultSeries& series : all) {
    has_means = has_means || !series.means.empty();
    for (const v1::Summary* summary : series.summaries) {
      ++points;
      if (const std::string text = absent_theory_text(*summary); !text.empty()) ++absent[text];
    }
  }
  if (has_means) add_note(chart, "points: means over the seeds, bars: 95 % confidence interval");
  if (labels.find(kDensified) != std::string::npos) add_note(chart, "d: densified within the plateau window");
  if (labels.find(kWarned) != std::string::npos) add_note(chart, "!:\u00A0with\u00A0warnings");
  for (const auto& [text, count] : absent) {
    add_note(chart, count < points ? fmt::format("{} at {} of {} points", text, count, points) : text);
  }
}

// A common first field; REQUIRES: there is a sweep.
const std::string& find_field(const std::vector<SweepResults>& sweeps) {
  for (const SweepResults& results : sweeps) {
    if (results.table.fields_size() == 0 || results.table.fields(0) != sweeps.front().table.fields(0)) {
      refuse(results.sweep.name() + " varies another first field than the others; name sweeps over the same field");
    }
  }
  return sweeps.front().table.fields(0);
}

}  // namespace

std::string axis_label(const std::string& field) {
  const FieldWords words = words_of(field);
  return words.unit.empty() ? words.name : fmt::format("{} ({})", words.name, words.unit);
}

Chart build_sweep_chart(const std::vector<SweepResults>& sweeps, const LogarithmicAxes& logarithmic) {
  const auto all = collect_series(sweeps);
  if (all.empty()) {
    refuse(kNoPlateauYet);
  }
  const std::string& field = find_field(sweeps);
  const bool speed = varies_speed_first(sweeps.front().table);
  Chart chart;
  chart.x = build_axis(field, all, logarithmic.x);
  double largest = 0.0;
  for (const ResultSeries& series : all) {
    for (const double stress : values_of(series, impact)) largest = std::max(largest, stress);
  }
  const ShownUnit unit = unit_by_size("MPa", largest);
  chart.y.label = fmt::format("plateau stress ({})", unit.name);
  if (sweeps.size() > 1) {
    for (std::size_t i = 0; i < all.size(); ++i) add_sweep(chart, all[i], speed, i);
    add_note(chart, "impact plate; dashed: shock theory (Eq. 51)");
  } else if (all.size() == 1) {
    add_series(chart, all.front(), speed, true, kImpactColour, unit);
  } else {
    for (std::size_t i = 0; i < all.size(); ++i)
      add_series(chart, all[i], speed, false, kSeriesColours[i % kSeriesColours.size()], unit);
    chart.note = "discs: impact plate; squares: support plate; ";
    const auto has_fit = [](const ResultSeries& series) { return find_plateau_fit(series).has_value(); };
    if (speed && std::ranges::any_of(all, has_fit)) chart.note += "solid: quadratic fit; ";
    chart.note += "dashed: Eq. 51; crosses: Eq. 52; dotted: Gibson-Ashby";
  }
  scale_y(chart, unit.factor);
  fit_stress_axis(chart, logarithmic.y);
  add_notes(chart, all);
  std::size_t drawn = 0;
  for (const ResultSeries& series : all) drawn += series.x.size();
  std::size_t rows = 0;
  for (const SweepResults& results : sweeps) rows += static_cast<std::size_t>(results.table.rows_size());
  const char* what = sweeps.front().table.means().empty() ? "jobs" : "points";
  if (drawn < rows) add_note(chart, fmt::format("{} of {} {} have no plateau", rows - drawn, rows, what));
  return chart;
}

}  // namespace cellcrush::client
