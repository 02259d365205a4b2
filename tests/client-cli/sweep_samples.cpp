#include "sweep_samples.h"

#include <algorithm>
#include <sstream>

#include "programs/text_proto.h"

namespace cellcrush::client::testing {

using cellcrush::testing::from_text;
using cellcrush::testing::with_text;

v1::Job make_job(int number, v1::Job::State state, double speed) {
  auto job = from_text<v1::Job>("words { plates: true }");
  job.set_name("jobs/" + std::to_string(number));
  job.set_state(state);
  job.mutable_case_()->mutable_loading()->set_speed_m_per_s(speed);
  const bool has_begun = state == v1::Job::RUNNING || state == v1::Job::SUCCEEDED;
  return has_begun ? with_text(job, "progress { fraction: 0.473 strain: 0.31 plateau_so_far_mpa: 3.39 }") : job;
}

v1::SweepTable make_table(int succeeded) {
  v1::SweepTable table;
  table.add_fields("loading.speed_m_per_s");
  for (int i = 1; i <= 4; ++i) {
    const double speed = 50.0 * i;
    auto& row = *table.add_rows();
    row.add_values(speed);
    *row.mutable_result() = make_job(i, i <= succeeded ? v1::Job::SUCCEEDED : v1::Job::FAILED, speed);
    row.set_job(row.result().name());
    if (i > succeeded) {
      row.mutable_result()->set_cause(v1::Job::ENERGY_BALANCE);
      row.mutable_result()->set_cause_message("the ledger opened");
      continue;
    }
    v1::Summary& summary = *row.mutable_result()->mutable_summary();
    summary = from_text<v1::Summary>(
        R"(step_count: 1000 plateau_window_low: 0.2 plateau_window_high: 0.4 plateau_stress_support_mpa: 0.44
           absorbed_energy_mj: 12345 energy_error_relative: 0.0121 theory { gibson_ashby_mpa: 0.301 })");
    summary.set_plateau_stress_impact_mpa(0.25 + 1e-4 * speed + 3e-4 * speed * speed);
    summary.set_crush_mode(i == 1 ? v1::Summary::CRUSH_MODE_V : v1::Summary::CRUSH_MODE_I);
    summary.set_crush_mode_words(i == 1 ? "V-shaped band (V)" : "layer by layer (I)");
    if (i > 1) summary.mutable_front()->set_shock_mpa(0.27 + 2.9e-4 * speed * speed);
    summary.mutable_theory()->set_shock_mpa(0.301 + 3.1e-4 * speed * speed);
  }
  return table;
}

v1::SweepTable make_averaged_table() {
  auto table = from_text<v1::SweepTable>(R"(
    fields: ["lattice.imperfection.seed", "loading.speed_m_per_s"]
    rows { job: "jobs/1" values: [1, 0.30000000000000004]
           result { state: SUCCEEDED summary { step_count: 10 plateau_window_low: 0.2 plateau_window_high: 0.4 } } }
    means { values: 0.30000000000000004 job_count: 3 succeeded_count: 3 warned_count: 1
            crush_modes { mode: CRUSH_MODE_V words: 'V-shaped band (V)' job_count: 2 } crush_modes { job_count: 1 }
            results { field: "plateau_stress_impact_mpa" job_count: 3 mean: 0.0341 deviation: 0.002 interval: 0.0049 }
            results { field: "plateau_stress_support_mpa" job_count: 3 mean: 0.025 deviation: 1e-18 interval: 2e-18 }
            results { field: "densification_strain" job_count: 1 mean: 0.658 }
            results { field: "theory.shock_mpa" job_count: 3 mean: 0.03 } })");
  *table.add_means() = table.means(0);
  auto& second = *table.mutable_means(1);
  second.set_values(0, 2.0);
  second.set_succeeded_count(2);
  second.set_failed_count(1);
  for (auto& result : *second.mutable_results()) result.set_job_count(std::min(result.job_count(), 2));
  second.mutable_results(0)->set_mean(0.0991);
  return table;
}

v1::SweepTable make_table(const char* fields, const std::vector<std::vector<double>>& rows) {
  auto table = from_text<v1::SweepTable>(fields);
  for (const auto& values : rows) {
    auto& row = *table.add_rows();
    row.mutable_values()->Add(values.begin(), values.end());
    row.mutable_result()->set_state(v1::Job::SUCCEEDED);
    row.mutable_result()->mutable_summary()->set_plateau_stress_impact_mpa(table.rows_size());
    row.mutable_result()->mutable_summary()->set_plateau_stress_support_mpa(0.5);
  }
  return table;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace cellcrush::client::testing
