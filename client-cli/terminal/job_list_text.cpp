#include "terminal/job_list_text.h"

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <map>
#include <utility>

#include "results/field_value.h"
#include "terminal/job_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using google::protobuf::util::TimeUtil;
using Align = Table::Align;

std::string also_varied_text(const std::vector<std::string>& fields, std::size_t shown, int width) {
  if (fields.size() <= shown) return {};
  std::string text = "Also varied: ";
  for (std::size_t i = shown; i < fields.size(); ++i) text += (i == shown ? "" : ", ") + fields[i];
  return wrapped(text, width, "", "  ");
}

double seconds(const google::protobuf::Duration& duration) {
  return std::max(static_cast<double>(TimeUtil::DurationToMilliseconds(duration)) / 1e3, 0.0);
}

std::string hold_text(const v1::Queue::Hold& hold) {
  const auto now = TimeUtil::GetCurrentTime();
  const std::string executor = executor_text(hold.executor());
  std::string text =
      fmt::format("the queue{} has been on hold ({}) for {}: {} {}", executor.empty() ? "" : " of " + executor,
                  hold.cause(), duration_text(seconds(now - hold.since())), hold.reason(), hold.remedy());
  if (hold.has_next_try_time())
    text += fmt::format(" The next attempt is in {}.", duration_text(seconds(hold.next_try_time() - now)));
  return text;
}

constexpr std::size_t kMostFields = 4;

// The fields in which jobs of one title differ.
std::vector<std::string> varied_fields_of(const std::vector<v1::Job>& jobs) {
  std::vector<const v1::Case*> cases;
  cases.reserve(jobs.size());
  for (const v1::Job& job : jobs) cases.push_back(&job.case_());
  return find_varied_fields(cases);
}

// A table whose rows stand below the titles of their cases.
class TitledRows {
 public:
  explicit TitledRows(Table& table) : table_(table) {}

  void add(const std::string& case_title, std::vector<std::string> cells) {
    const std::string title = base_title(case_title);
    if (title != above_) table_.add_title(title.empty() ? "untitled" : title);
    above_ = title;
    table_.add(std::move(cells));
  }

 private:
  Table& table_;
  std::string above_;
};

}  // namespace

std::string job_list_text(const std::vector<v1::Job>& jobs, int width) {
  constexpr std::size_t kHeadings = 2;
  if (jobs.empty()) return "no jobs\n";
  const auto varied = varied_fields_of(jobs);
  const std::vector<std::string> fields(varied.begin(), varied.begin() + std::min(varied.size(), kMostFields));
  std::vector<Align> columns = {Align::left, Align::left, Align::right, Align::right};
  columns.insert(columns.end(), fields.size(), Align::right);
  columns.insert(columns.end(), {Align::right, Align::left, Align::left, Align::left, Align::left, Align::left,
                                 Align::left, Align::left});
  Table table(columns);
  std::vector<std::string> headings = {"NAME", "STATE", "DONE", "PLATEAU"};
  double largest = 0.0;
  for (const v1::Job& job : jobs) largest = std::max(largest, job.summary().plateau_stress_impact_mpa());
  const ShownUnit stress = unit_by_size("MPa", largest);
  std::vector<std::string> units = {"", "", "", stress.name};
  append_words(fields, headings, units);
  headings.insert(headings.end(), {"PRIORITY", "EXECUTOR", "PLACE", "SWEEP", "OWNER", "LABELS", "NOTE", "CREATED"});
  table.add(std::move(headings));
  table.add(std::move(units));
  TitledRows rows(table);
  for (const v1::Job& job : jobs) {
    const bool plateau = job.summary().has_plateau_stress_impact_mpa();
    const bool started = job.state() != v1::Job::PENDING && job.has_progress();
    const double done = job.state() == v1::Job::SUCCEEDED ? 1.0 : job.progress().fraction();
    std::vector<std::string> cells = {
        job.name(), v1::Job::State_Name(job.state()), started || done > 0.0 ? percent_text(done, 0) : "",
        plateau ? number_text(stress.factor * job.summary().plateau_stress_impact_mpa()) : ""};
    for (const std::string& field : fields) cells.push_back(short_value_text(job.case_(), field));
    cells.insert(cells.end(), {job.priority() != 0 ? std::to_string(job.priority()) : "", executor_text(job.executor()),
                               job.place(), job.sweep(), job.owner(), labels_text(job.labels()),
                               short_note_text(job.note()), job.has_create_time() ? time_text(job.create_time()) : ""});
    rows.add(job.case_().title(), std::move(cells));
  }
  const std::string constants = constants_text(table.remove_constant_columns(2, kHeadings), width);
  return table.text(0, width) + constants + also_varied_text(varied, fields.size(), width);
}

std::string status_text(const v1::Capabilities& server, const v1::Queue& queue, int width) {
  Table table({Align::left, Align::left});
  table.add({"version", printable(server.version())});
  if (server.has_start_time())  // an older one does not tell
    table.add({"runs for", duration_text(seconds(TimeUtil::GetCurrentTime() - server.start_time()))});
  if (server.draining()) table.add({"accepts jobs", "no, it is being drained"});
  table.add({"uses", printable(queue.cores())});
  if (server.has_start_time())
    table.add({"free disk", fmt::format("{}; jobs wait below {}", size_text(server.free_disk_bytes()),
                                        size_text(server.kept_disk_bytes()))});
  for (const auto& executor : server.executors()) {
    table.add({"runs on " + printable(executor.name()),
               fmt::format("{} of {} at once",
                           count_text(executor.running_count()) + (executor.running_count() == 1 ? " job" : " jobs"),
                           count_text(executor.job_limit()))});
  }
  table.add({"waiting jobs", count_text(server.waiting_count())});
  std::string text = table.text(0, width);
  for (const auto& hold : queue.holds()) text += wrapped(hold_text(hold), width);
  return text;
}

std::string queue_text(const v1::Queue& queue, const std::vector<v1::Job>& jobs, int width) {
  std::string held;
  for (const auto& hold : queue.holds()) held += wrapped(hold_text(hold), width);
  if (!queue.cores().empty()) held += "the server uses " + printable(queue.cores()) + "\n";
  if (queue.entries_size() == 0) return held + "the queue is empty\n";
  std::vector<std::string> fields = varied_fields_of(jobs);
  fields.resize(std::min(fields.size(), kMostFields));
  std::map<std::string, const v1::Case*> cases;
  for (const v1::Job& job : jobs) cases[job.name()] = &job.case_();
  const bool priorities = std::any_of(queue.entries().begin(), queue.entries().end(),
                                      [](const v1::Queue::Entry& entry) { return entry.priority() != 0; });
  const bool executors = std::any_of(queue.entries().begin(), queue.entries().end(), [](const v1::Queue::Entry& entry) {
    return !executor_text(entry.executor()).empty();
  });
  std::vector<Align> columns = {Align::left};
  columns.insert(columns.end(), fields.size() + 1, Align::right);
  columns.insert(columns.end(), 1 + (priorities ? 1 : 0) + (executors ? 1 : 0), Align::left);
  Table table(columns);
  std::vector<std::string> headings = {"JOB"};
  std::vector<std::string> units = {""};
  append_words(fields, headings, units);
  headings.emplace_back("STARTS IN");
  if (priorities) headings.emplace_back("PRIORITY");
  if (executors) headings.emplace_back("EXECUTOR");
  headings.emplace_back("REASON");
  table.add(std::move(headings));
  table.add(std::move(units));
  TitledRows rows(table);
  for (const auto& entry : queue.entries()) {
    const auto known = cases.find(entry.job());
    std::vector<std::string> cells = {entry.job()};
    for (const std::string& field : fields)
      cells.push_back(known == cases.end() ? std::string() : short_value_text(*known->second, field));
    cells.push_back(entry.seconds_until_start() > 0 ? duration_text(entry.seconds_until_start()) : "");
    if (priorities) cells.push_back(entry.priority() != 0 ? std::to_string(entry.priority()) : "");
    if (executors) cells.push_back(entry.executor());
    cells.push_back(entry.reason());
    rows.add(known == cases.end() ? "" : known->second->title(), std::move(cells));
  }
  std::string text = held + table.text(0, width);
  if (queue.more_count() > 0) text += fmt::format("and {} more\n", count_text(queue.more_count()));
  return text;
}

}  // namespace cellcrush::client
