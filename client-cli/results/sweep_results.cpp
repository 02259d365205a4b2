#include "results/sweep_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "results/field_value.h"
#include "terminal/number_text.h"

namespace cellcrush::client {

namespace {

std::string other_values_text(const v1::SweepTable& table, const v1::SweepTable::Row& row) {
  std::string text;
  for (int i = 1; i < table.fields_size(); ++i) {
    text += (text.empty() ? "" : ", ") +
            equation_text(table.fields(i), short_text(row.values(i)), {table.fields().begin(), table.fields().end()});
  }
  return text;
}

}  // namespace

std::optional<double> find_interval(const v1::SweepTable::SeedMeans& means, std::string_view path) {
  constexpr double kRoundOff = 1e-9;
  const auto* mean = find_mean(means, path);
  const bool known = mean != nullptr && mean->interval() > kRoundOff * std::abs(mean->mean());
  return known ? std::optional(mean->interval()) : std::nullopt;
}

std::string absent_theory_text(const v1::Summary& summary) {
  if (!summary.has_plateau_stress_impact_mpa()) return {};
  if (summary.theory().shock_mpa() <= 0.0) return "Eq. 51: known of regular lattices only";
  return summary.has_front() ? "" : "Eq. 52: no front";
}

std::vector<ResultSeries> split_series(const v1::SweepTable& table) {
  std::map<std::vector<double>, std::size_t> places;  // in `all`, by the other values
  std::vector<std::vector<int>> rows;                 // of each series
  std::vector<ResultSeries> all;
  for (int i = 0; i < table.rows_size(); ++i) {
    const auto& row = table.rows(i);
    const v1::Summary& summary = row.result().summary();
    const bool plateau = summary.has_plateau_stress_impact_mpa() && summary.has_plateau_stress_support_mpa();
    if (row.result().state() != v1::Job::SUCCEEDED || !plateau || row.values_size() != table.fields_size()) continue;
    const std::vector<double> others(row.values().begin() + std::min(1, row.values_size()), row.values().end());
    const auto [place, is_new] = places.try_emplace(others, all.size());
    if (is_new) {
      all.emplace_back().name = other_values_text(table, row);
      rows.emplace_back();
    }
    rows[place->second].push_back(i);
  }
  const auto x_of = [&](int row) { return table.fields_size() > 0 ? table.rows(row).values(0) : 0.0; };
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::ranges::stable_sort(rows[i], {}, x_of);
    for (const int row : rows[i]) {
      all[i].x.push_back(x_of(row));
      all[i].summaries.push_back(&table.rows(row).result().summary());
      if (!table.means().empty()) all[i].means.push_back(&table.means(row));
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
