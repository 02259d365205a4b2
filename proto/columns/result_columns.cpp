#include "columns/result_columns.h"

#include <fmt/format.h>
#include <google/protobuf/repeated_field.h>

#include <algorithm>

namespace cellcrush {

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
Value valid_to_strain(Of s) { return known(s.has_valid_to_strain(), s.valid_to_strain()); }
Value absorbed_energy(Of s) { return known(s.step_count() > 0, s.absorbed_energy_mj()); }
Value gibson_ashby(Of s) { return known(s.theory().shock_mpa() > 0.0, s.theory().gibson_ashby_mpa()); }
Value shock_stress(Of s) { return known(s.theory().shock_mpa() > 0.0, s.theory().shock_mpa()); }
Value front_shock(Of s) { return known(s.has_front(), s.front().shock_mpa()); }
Value front_strain(Of s) { return known(s.has_front(), s.front().strain_behind()); }
Value energy_error(Of s) { return known(s.step_count() > 0, s.energy_error_relative()); }

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
      {{"valid", "to", "strain"}, "", "valid_to_strain", "valid_to_strain", "-", valid_to_strain},
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
  v1::SweepTable out = shown_table(table, each || table.fields_size() == 1);
  const auto seed = std::ranges::find(out.fields(), kSeedField) - out.fields().begin();
  const auto to_the_end = [&](auto& list) { std::rotate(list.begin() + seed, list.begin() + seed + 1, list.end()); };
  if (seed == out.fields_size()) return out;
  to_the_end(*out.mutable_fields());
  for (auto& row : *out.mutable_rows()) {
    if (row.values_size() == out.fields_size()) to_the_end(*row.mutable_values());
  }
  return out;
}

const v1::SweepTable::Mean* find_mean(const v1::SweepTable::SeedMeans& means, std::string_view path) {
  const auto found = std::ranges::find_if(means.results(), [&](const auto& mean) { return mean.field() == path; });
  return found == means.results().end() ? nullptr : &*found;
}

std::optional<double> result_of(const v1::SweepTable& results, int row, const ResultColumn& column) {
  if (results.means().empty()) return column.value(results.rows(row).result().summary());
  const auto* mean = find_mean(results.means(row), column.path);
  return mean == nullptr ? std::nullopt : std::optional(mean->mean());
}

std::string crush_mode_code(v1::Summary::CrushMode mode) {
  constexpr std::string_view kPrefix = "CRUSH_MODE_";
  const std::string& name = v1::Summary::CrushMode_Name(mode);
  if (mode == v1::Summary::CRUSH_MODE_UNSPECIFIED || name.size() < kPrefix.size()) return {};
  return name.substr(kPrefix.size());
}

}  // namespace cellcrush
