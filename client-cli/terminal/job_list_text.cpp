#include "terminal/job_list_text.h"

#include <algorithm>
#include <utility>

#include "results/case_differences.h"
#include "results/field_value.h"
#include "terminal/executor_text.h"
#include "terminal/job_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;

std::string also_varied_text(const std::vector<std::string>& fields, std::size_t shown, int width) {
  if (fields.size() <= shown) return {};
  std::string text = "Also varied: ";
  for (std::size_t i = shown; i < fields.size(); ++i) text += (i == shown ? "" : ", ") + fields[i];
  return wrapped(text, width, "", "  ");
}

}  // namespace

std::string job_list_text(const std::vector<v1::Job>& jobs, int width) {
  constexpr std::size_t kMostFields = 4;
  constexpr std::size_t kHeadings = 2;
  if (jobs.empty()) return "no jobs\n";
  std::vector<const v1::Case*> cases;
  cases.reserve(jobs.size());
  for (const v1::Job& job : jobs) cases.push_back(&job.case_());
  const auto varied = find_varied_fields(cases);
  const std::vector<std::string> fields(varied.begin(), varied.begin() + std::min(varied.size(), kMostFields));
  std::vector<Align> columns = {Align::left, Align::left, Align::right, Align::right};
  columns.insert(columns.end(), fields.size(), Align::right);
  columns.insert(columns.end(), {Align::right, Align::left, Align::left, Align::left, Align::left});
  Table table(columns);
  std::vector<std::string> headings = {"NAME", "STATE", "DONE", "PLATEAU"};
  std::vector<std::string> units = {"", "", "", "MPa"};
  for (const std::string& field : fields) {
    const FieldWords words = words_among(field, fields);
    headings.push_back(words.name);
    units.push_back(words.unit);
  }
  headings.insert(headings.end(), {"PRIORITY", "EXECUTOR", "PLACE", "LABELS", "CREATED"});
  table.add(std::move(headings));
  table.add(std::move(units));
  std::string title_above;
  for (const v1::Job& job : jobs) {
    const std::string title = base_title(job.case_().title());
    if (title != title_above) table.add_title(title.empty() ? "untitled" : title);
    title_above = title;
    const bool plateau = job.summary().has_plateau_stress_impact_mpa();
    const bool started = job.state() != v1::Job::PENDING && job.has_progress();
    const double done = job.state() == v1::Job::SUCCEEDED ? 1.0 : job.progress().fraction();
    std::vector<std::string> cells = {job.name(), v1::Job::State_Name(job.state()),
                                      started || done > 0.0 ? percent_text(done, 0) : "",
                                      plateau ? number_text(job.summary().plateau_stress_impact_mpa()) : ""};
    for (const std::string& field : fields) cells.push_back(field_value_text(job.case_(), field));
    cells.insert(cells.end(),
                 {job.priority() != 0 ? std::to_string(job.priority()) : "", executor_text(job.executor()), job.place(),
                  labels_text(job.labels()), job.has_create_time() ? time_text(job.create_time()) : ""});
    table.add(std::move(cells));
  }
  const std::string constants = constants_text(table.remove_constant_columns(2, kHeadings), width);
  return table.text(0, width) + constants + also_varied_text(varied, fields.size(), width);
}

}  // namespace cellcrush::client
