#include "columns/result_columns.h"

#include <fmt/format.h>
#include <google/protobuf/repeated_field.h>

#include <algorithm>

namespace cellcrush {

namespace {

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

std::string ResultColumn::field() const {
  constexpr std::string_view kTheory = "theory.";
  std::string name(std::string_view(path).starts_with(kTheory) ? path + kTheory.size() : path);
  std::ranges::replace(name, '.', '_');
  return name;
}

std::optional<double> find_result(const v1::Summary& summary, std::string_view path) {
  const google::protobuf::Message* message = &summary;
  const std::size_t dot = path.find('.');
  const auto* field = summary.GetDescriptor()->FindFieldByName(std::string(path.substr(0, dot)));
  if (dot != std::string_view::npos) {
    if (!summary.GetReflection()->HasField(summary, field)) return std::nullopt;
    message = &summary.GetReflection()->GetMessage(summary, field);
    field = message->GetDescriptor()->FindFieldByName(std::string(path.substr(dot + 1)));
  }
  const bool must_be_set = field->has_presence() || message->GetDescriptor() == v1::Theory::descriptor();
  if (must_be_set && !message->GetReflection()->HasField(*message, field)) return std::nullopt;
  return message->GetReflection()->GetDouble(*message, field);
}

const std::vector<ResultColumn>& result_columns() {
  static const std::vector<ResultColumn> kColumns = {
      {{"plateau", "impact", "plate"}, "MPa", "plateau_stress_impact_mpa"},
      {{"plateau", "support", "plate"}, "MPa", "plateau_stress_support_mpa"},
      {{"plateau", "up to", "densif."}, "MPa", "plateau_stress_to_densification_mpa"},
      {{"densif.", "strain", ""}, "", "densification_strain"},
      {{"absorbed", "energy", ""}, "mJ", "absorbed_energy_mj"},
      {{"quasi-", "static", "theory"}, "MPa", "theory.gibson_ashby_mpa"},
      {{"shock", "theory", "Eq. 51"}, "MPa", "theory.shock_mpa"},
      {{"shock", "theory", "Eq. 52"}, "MPa", "front.shock_mpa", "no front"},
      {{"strain", "behind", "front"}, "", "front.strain_behind", "no front"},
      {{"energy", "ledger", "error"}, "%", "energy_error_relative"},
      {{"valid", "to", "strain"}, "", "valid_to_strain"},
      {{"solid", "fraction", "at densif."}, "", "solid_fraction_at_densification"},
      {{"mean", "crush", "force"}, "N", "crush_forces.mean_n"},
      {{"peak", "crush", "force"}, "N", "crush_forces.peak_n"},
      {{"crush", "force", "efficiency"}, "", "crush_forces.efficiency"},
      {{"specific", "energy", "absorbed"}, "J/g", "crush_forces.specific_energy_j_per_g"},
      {{"Poisson's", "ratio", ""}, "", "poissons_ratio"},
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
  if (results.means().empty()) {
    const v1::Summary& summary = results.rows(row).result().summary();
    return summary.step_count() > 0 ? find_result(summary, column.path) : std::nullopt;
  }
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
