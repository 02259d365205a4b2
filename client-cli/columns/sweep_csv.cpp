#include "columns/sweep_csv.h"

#include <fmt/format.h>

#include <string_view>

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

// "V" of CRUSH_MODE_V; empty if unspecified.
std::string crush_mode_code(v1::Summary::CrushMode mode) {
  constexpr std::string_view kPrefix = "CRUSH_MODE_";
  const std::string& name = v1::Summary::CrushMode_Name(mode);
  if (mode == v1::Summary::CRUSH_MODE_UNSPECIFIED || name.size() < kPrefix.size()) return {};
  return name.substr(kPrefix.size());
}

}  // namespace

const std::vector<ResultColumn>& result_columns() {
  static const std::vector<ResultColumn> kColumns = {
      {{"plateau", "impact", "plate"}, "MPa", "plateau_stress_impact_mpa", 1.0, plateau_stress_impact},
      {{"plateau", "support", "plate"}, "MPa", "plateau_stress_support_mpa", 1.0, plateau_stress_support},
      {{"plateau", "up to", "densif."}, "MPa", "plateau_stress_to_densification_mpa", 1.0, plateau_to_densification},
      {{"densif.", "strain", ""}, "", "densification_strain", 1.0, densification_strain},
      {{"absorbed", "energy", ""}, "J", "absorbed_energy_mj", 1e-3, absorbed_energy},
      {{"quasi-", "static", "theory"}, "MPa", "gibson_ashby_mpa", 1.0, gibson_ashby},
      {{"shock", "theory", "Eq. 51"}, "MPa", "shock_mpa", 1.0, shock_stress},
      {{"shock", "theory", "Eq. 52"}, "MPa", "front_shock_mpa", 1.0, front_shock},
      {{"strain", "behind", "front"}, "", "front_strain_behind", 1.0, front_strain},
      {{"energy", "ledger", "error"}, "%", "energy_error_relative", 100.0, energy_error},
  };
  return kColumns;
}

std::string value_text(double value) { return fmt::format("{}", value); }

std::string sweep_table_csv(const v1::SweepTable& table, Decimal decimal) {
  CsvText text(decimal);
  for (const std::string& field : table.fields()) text.add(field);
  for (const char* name : {"job", "state"}) text.add(name);
  for (const ResultColumn& column : result_columns()) text.add(column.field);
  text.add("crush_mode");
  text.end_row();
  for (const auto& row : table.rows()) {
    const v1::Summary& summary = row.result().summary();
    for (int i = 0; i < table.fields_size(); ++i)
      text.add(i < row.values_size() ? std::optional(row.values(i)) : std::nullopt);
    text.add(row.job());
    text.add(v1::Job::State_Name(row.result().state()));
    for (const ResultColumn& column : result_columns()) text.add(column.value(summary));
    text.add(crush_mode_code(summary.crush_mode()));
    text.end_row();
  }
  return text.take();
}

}  // namespace cellcrush::client
