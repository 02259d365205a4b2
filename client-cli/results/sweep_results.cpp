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

std::optional<double> known(bool has, double value) { return has ? std::optional(value) : std::nullopt; }

using Value = std::optional<double>;
using Of = const v1::Summary&;

Value plateau_stress_impact(Of s) { return known(s.has_plateau_stress_impact_mpa(), s.plateau_stress_impact_mpa()); }
Value plateau_stress_support(Of s) { return known(s.has_plateau_stress_support_mpa(), s.plateau_stress_support_mpa()); }
Value plateau_to_densification(Of s) {
  return known(s.has_plateau_stress_to_densification_mpa(), s.plateau_stress_to_densification_mpa());
}
Value densification_strain(Of s) { return known(s.has_densification_strain(), s.densification_strain()); }
Value absorbed_energy(Of s) { return known(s.step_count() > 0, s.absorbed_energy_mj()); }
Value gibson_ashby(Of s) { return known(s.theory().shock_mpa() > 0.0, s.theory().gibson_ashby_mpa()); }
Value shock_stress(Of s) { return known(s.theory().shock_mpa() > 0.0, s.theory().shock_mpa()); }
Value front_shock(Of s) { return known(s.has_front(), s.front().shock_mpa()); }
Value front_strain(Of s) { return known(s.has_front(), s.front().strain_behind()); }
Value energy_error(Of s) { return known(s.step_count() > 0, s.energy_error_relative()); }

constexpr std::string_view kSeedField = "lattice.imperfection.seed";

std::string other_values_text(const v1::SweepTable& table, const v1::SweepTable::Row& row) {
  std::string text;
  for (int i = 1; i < table.fields_size(); ++i) {
    text += (text.empty() ? "" : ", ") +
            equation_text(table.fields(i), short_text(row.values(i)), {table.fields().begin(), table.fields().end()});
  }
  return text;
}

// Sets a number of a summary by its path.
void set_result(v1::Summary& summary, std::string_view path, double value) {
  google::protobuf::Message* message = &summary;
  const std::size_t dot = path.find('.');
  const auto* field = message->GetDescriptor()->FindFieldByName(std::string(path.substr(0, dot)));
  if (field != nullptr && dot != std::string_view::npos) {
    message = message->GetReflection()->MutableMessage(message, field);
    field = message->GetDescriptor()->FindFieldByName(std::string(path.substr(dot + 1)));
  }
  if (field != nullptr) message->GetReflection()->SetDouble(message, field, value);
}

// A job whose summary holds the means. `any` is the summary of a succeeded job: the plateau window is that of all.
v1::Job mean_job(const v1::SweepTable::SeedMeans& means, const v1::Summary& any) {
  v1::Job job;
  if (means.succeeded_count() == 0) return job;
  job.set_state(v1::Job::SUCCEEDED);
  v1::Summary& summary = *job.mutable_summary();
  summary.set_plateau_window_low(any.plateau_window_low());
  summary.set_plateau_window_high(any.plateau_window_high());
  summary.set_step_count(any.step_count());
  for (const auto& result : means.results()) set_result(summary, result.field(), result.mean());
  if (means.crush_modes_size() == 0) return job;
  const auto& most = means.crush_modes(0);
  summary.set_crush_mode(most.mode());
  summary.set_crush_mode_words(most.words());
  if (most.job_count() < means.succeeded_count())
    *summary.mutable_crush_mode_words() += fmt::format(", {} of {}", most.job_count(), means.succeeded_count());
  return job;
}

}  // namespace

const std::vector<ResultColumn>& result_columns() {
  static const std::vector<ResultColumn> kColumns = {
      {{"plateau", "impact", "plate"},
       "MPa",
       "plateau_stress_impact_mpa",
       "plateau_stress_impact_mpa",
       "-",
       plateau_stress_impact},
      {{"plateau", "support", "plate"},
       "MPa",
       "plateau_stress_support_mpa",
       "plateau_stress_support_mpa",
       "-",
       plateau_stress_support},
      {{"plateau", "up to", "densif."},
       "MPa",
       "plateau_stress_to_densification_mpa",
       "plateau_stress_to_densification_mpa",
       "-",
       plateau_to_densification},
      {{"densif.", "strain", ""}, "", "densification_strain", "densification_strain", "-", densification_strain},
      {{"absorbed", "energy", ""}, "mJ", "absorbed_energy_mj", "absorbed_energy_mj", "-", absorbed_energy},
      {{"quasi-", "static", "theory"}, "MPa", "gibson_ashby_mpa", "theory.gibson_ashby_mpa", "-", gibson_ashby},
      {{"shock", "theory", "Eq. 51"}, "MPa", "shock_mpa", "theory.shock_mpa", "-", shock_stress},
      {{"shock", "theory", "Eq. 52"}, "MPa", "front_shock_mpa", "front.shock_mpa", "no front", front_shock},
      {{"strain", "behind", "front"}, "", "front_strain_behind", "front.strain_behind", "no front", front_strain},
      {{"energy", "ledger", "error"}, "%", "energy_error_relative", "energy_error_relative", "-", energy_error},
  };
  return kColumns;
}

v1::SweepTable shown_table(const v1::SweepTable& table, bool each) {
  v1::SweepTable out;
  if (each || table.means().empty()) {
    out = table;
    out.clear_means();
    return out;
  }
  std::ranges::copy_if(table.fields(), google::protobuf::RepeatedFieldBackInserter(out.mutable_fields()),
                       [](const std::string& field) { return field != kSeedField; });
  const auto succeeded =
      std::ranges::find_if(table.rows(), [](const auto& row) { return row.result().state() == v1::Job::SUCCEEDED; });
  for (const auto& means : table.means()) {
    auto& row = *out.add_rows();
    *row.mutable_values() = means.values();
    if (succeeded != table.rows().end()) *row.mutable_result() = mean_job(means, succeeded->result().summary());
  }
  *out.mutable_means() = table.means();
  return out;
}

v1::SweepTable charted_table(const v1::SweepTable& table, bool each) {
  return shown_table(table, each || table.fields_size() == 1);
}

const v1::SweepTable::Mean* find_mean(const v1::SweepTable::SeedMeans& means, std::string_view path) {
  const auto found = std::ranges::find_if(means.results(), [&](const auto& mean) { return mean.field() == path; });
  return found == means.results().end() ? nullptr : &*found;
}

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
