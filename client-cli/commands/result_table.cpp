#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "commands/commands.h"
#include "connection/connection.h"
#include "results/field_value.h"

namespace cellcrush::client {
namespace {

std::optional<double> number_at(const v1::Case& scene, const std::string& field) {
  const std::string text = field_value_text(scene, field);
  double out = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return out;
}

}  // namespace

ResultTable tabulate_results(Session& session, const std::vector<std::string>& files) {
  std::vector<v1::Job> jobs;
  for (const std::string& name : session.find_jobs(files)) jobs.push_back(fetch_job(session.connection(), name));
  std::vector<const v1::Case*> cases;
  cases.reserve(jobs.size());
  for (const v1::Job& job : jobs) cases.push_back(&job.case_());
  ResultTable out;
  v1::SweepTable& table = out.table;
  for (const std::string& field : find_differences(cases)) {
    const auto is_number = [&](const v1::Case* scene) { return number_at(*scene, field).has_value(); };
    if (std::ranges::all_of(cases, is_number)) {
      table.add_fields(field);
    } else {
      out.note += (out.note.empty() ? "The cases also differ in " : ", ") + field;
    }
  }
  if (!out.note.empty()) out.note += '.';
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    v1::SweepTable::Row& row = *table.add_rows();
    row.set_job(files[i]);
    for (const std::string& field : table.fields()) row.add_values(*number_at(*cases[i], field));
    *row.mutable_result() = jobs[i];
    row.mutable_result()->clear_case_();
  }
  return out;
}

}  // namespace cellcrush::client
