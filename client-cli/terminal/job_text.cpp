#include "terminal/job_text.h"

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "command_error.h"
#include "terminal/case_text.h"
#include "terminal/number_text.h"
#include "terminal/summary_text.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;
using google::protobuf::util::TimeUtil;

// The daemon gives times in whole seconds, rounded down, so the run took less than one second more.
std::string run_time_text(const v1::Job& job) {
  if (!job.has_start_time() || !job.has_end_time()) return {};
  const auto whole = static_cast<double>(TimeUtil::DurationToSeconds(job.end_time() - job.start_time()) + 1);
  return whole < 10.0 ? fmt::format("{} s", whole) : duration_text(whole);
}

void add_progress_rows(Table& table, const v1::Job& job) {
  const v1::Progress& progress = job.progress();
  std::string text = percent_text(progress.fraction());
  if (has_strain(job.words())) text += fmt::format(", strain {:.3f}", progress.strain());
  table.add({"progress",
             text + fmt::format(", step {} of {}", count_text(progress.step()), count_text(progress.step_count()))});
  if (progress.stalled()) table.add({"", "the worker has stalled; it is replaced if it stays so"});
  if (job.state() == v1::Job::RUNNING && progress.steps_per_second() > 0) {
    table.add({"time left", duration_text(progress.seconds_left()) + " at " + number_text(progress.steps_per_second()) +
                                " steps/s"});
  }
  if (progress.has_plateau_so_far_mpa())
    table.add({"plateau so far", quantity_text(progress.plateau_so_far_mpa(), "MPa")});
}

std::string stage_times_text(const v1::StageTimes& times, int width) {
  const std::pair<const char*, double> stages[] = {
      {"integrate motion", times.integrate_motion_s()},  {"internal forces", times.evaluate_internal_forces_s()},
      {"find contacts", times.find_contacts_s()},        {"contact forces", times.evaluate_contact_forces_s()},
      {"plate forces", times.evaluate_plate_forces_s()}, {"loads", times.evaluate_loads_s()}};
  double all = 0.0;
  for (const auto& [name, seconds] : stages) all += seconds;
  if (all <= 0.0) return {};
  Table table({Align::left, Align::right, Align::right});
  table.add({"step time by stage", number_text(all) + " s"});
  for (const auto& [name, seconds] : stages) {
    table.add({name, number_text(seconds) + " s", percent_text(seconds / all)});
  }
  return table.text(2, width);
}

}  // namespace

std::string outcome_text(const v1::Job& job, int width) {
  std::string text = printable(job.name()) + " " + v1::Job::State_Name(job.state());
  if (job.state() == v1::Job::FAILED && job.cause() != v1::Job::JOB_CAUSE_UNSPECIFIED)
    text += " (" + v1::Job::Cause_Name(job.cause()) + ")";
  const std::string run_time = run_time_text(job);
  if (!run_time.empty()) text += " within " + run_time;
  if (job.has_summary()) {
    text += fmt::format(": {} steps, {} of solver time", count_text(job.summary().step_count()),
                        duration_text(job.summary().solver_seconds()));
  }
  text = wrapped(text, width, "", "  ");
  if (!job.cause_message().empty()) text += wrapped(printable(job.cause_message()), width, "  ", "  ");
  if (!job.remedy().empty()) text += wrapped("Remedy: " + printable(job.remedy()), width, "  ", "    ");
  if (job.has_summary()) text += '\n' + summary_text(job, width);
  return text;
}

std::string description_text(const v1::Job& job, int width) {
  Table table({Align::left, Align::left});
  if (!job.case_().title().empty()) table.add({"title", job.case_().title()});
  const std::string scene = scene_text(job.words());
  if (!scene.empty()) table.add({"case", scene});
  add_note_rows(table, job.note());
  if (!job.labels().empty()) table.add({"labels", labels_text(job.labels())});
  if (job.priority() != 0) table.add({"priority", std::to_string(job.priority())});
  if (job.time_limit_s() > 0.0) table.add({"time limit", duration_text(job.time_limit_s())});
  if (const std::string executor = executor_text(job.executor()); !executor.empty()) table.add({"executor", executor});
  if (!job.place().empty()) table.add({"place", job.place()});
  if (!job.retry_of().empty()) table.add({"retry of", job.retry_of()});
  if (!job.owner().empty()) table.add({"owner", job.owner()});
  if (job.has_create_time()) table.add({"created", time_text(job.create_time())});
  if (job.has_start_time()) table.add({"started", time_text(job.start_time())});
  if (job.has_end_time()) table.add({"ended", time_text(job.end_time())});
  if (job.worker_pid() != 0) table.add({"worker process", std::to_string(job.worker_pid())});
  if (job.attempt() > 1) {
    table.add(
        {"workers", fmt::format("{}; {} {} lost or left the job, and the work since the last checkpoint was repeated",
                                job.attempt(), job.attempt() - 1, job.attempt() == 2 ? "was" : "were")});
  }
  if (job.has_progress() && !is_final(job.state())) add_progress_rows(table, job);
  const std::string scene_lines = facts_text(job.words(), width);
  const std::string stage_lines = stage_times_text(job.summary().stage_times(), width);
  return outcome_text(job, width) + (stage_lines.empty() ? "" : '\n' + stage_lines) + '\n' + table.text(2, width) +
         (scene_lines.empty() ? "" : '\n' + scene_lines);
}

std::string labels_text(const google::protobuf::Map<std::string, std::string>& labels) {
  const std::map<std::string, std::string> ordered(labels.begin(), labels.end());
  std::string text;
  for (const auto& [key, value] : ordered) text += fmt::format("{}{}={}", text.empty() ? "" : ", ", key, value);
  return text;
}

void add_note_rows(Table& table, const std::string& note) {
  std::istringstream lines(note);
  std::string heading = "note";
  for (std::string line; std::getline(lines, line); heading.clear()) table.add({heading, line});
}

std::string short_note_text(const std::string& note) {
  constexpr int kWidth = 40;
  return cut(note.substr(0, note.find('\n')), kWidth);
}

std::string time_text(const google::protobuf::Timestamp& time) {
  return TimeUtil::ToString(TimeUtil::SecondsToTimestamp(time.seconds()));
}

}  // namespace cellcrush::client
