#include "results/sweep_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "results/field_value.h"

namespace cellcrush::client {

namespace {

std::string other_values_text(const v1::SweepTable& table, const v1::SweepTable::Row& row) {
  std::string text;
  for (int i = 1; i < table.fields_size(); ++i) {
    text += (text.empty() ? "" : ", ") +
            equation_text(table.fields(i), value_text(row.values(i)), {table.fields().begin(), table.fields().end()});
  }
  return text;
}

}  // namespace

std::vector<ResultSeries> split_series(const v1::SweepTable& table) {
  struct Point {
    double x = 0.0;
    const v1::Summary* summary = nullptr;
  };
  std::vector<std::pair<std::string, std::vector<Point>>> groups;
  for (const auto& row : table.rows()) {
    const v1::Summary& summary = row.result().summary();
    const bool plateau = summary.has_plateau_stress_impact_mpa() && summary.has_plateau_stress_support_mpa();
    if (row.result().state() != v1::Job::SUCCEEDED || !plateau || row.values_size() != table.fields_size()) continue;
    const std::string name = other_values_text(table, row);
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& known) { return known.first == name; });
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->second.push_back({row.values_size() > 0 ? row.values(0) : 0.0, &summary});
  }
  std::vector<ResultSeries> all;
  for (auto& [name, points] : groups) {
    std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    ResultSeries& series = all.emplace_back();
    series.name = name;
    for (const Point& point : points) {
      series.x.push_back(point.x);
      series.summaries.push_back(point.summary);
    }
  }
  return all;
}

bool varies_speed_first(const v1::SweepTable& table) {
  return table.fields_size() > 0 && table.fields(0) == "loading.speed_m_per_s";
}

std::vector<double> values_of(const ResultSeries& series, double (*value)(const v1::Summary& summary)) {
  std::vector<double> values;
  values.reserve(series.summaries.size());
  for (const v1::Summary* summary : series.summaries) values.push_back(value(*summary));
  return values;
}

std::optional<QuadraticFit> find_plateau_fit(const ResultSeries& series) {
  return find_quadratic_fit(series.x,
                            values_of(series, [](const v1::Summary& s) { return s.plateau_stress_impact_mpa(); }));
}

std::optional<QuadraticFit> find_shock_curve(const ResultSeries& series) {
  // The highest speed loses the least to rounding.
  for (std::size_t i = series.x.size(); i-- > 0;) {
    const v1::Theory& job_theory = series.summaries[i]->theory();
    if (series.x[i] <= 0.0 || job_theory.shock_mpa() <= 0.0) continue;
    const double rise = job_theory.shock_mpa() - job_theory.gibson_ashby_mpa();
    return QuadraticFit{job_theory.gibson_ashby_mpa(), 0.0, rise / (series.x[i] * series.x[i]), 0.0, 0};
  }
  return std::nullopt;
}

}  // namespace cellcrush::client
