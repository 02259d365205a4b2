#include "terminal/sweep_progress.h"

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "columns/swept_fields.h"
#include "command_error.h"
#include "results/field_value.h"
#include "terminal/case_text.h"
#include "terminal/number_text.h"
#include "terminal/sweep_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;
using Entry = SweepView::Entry;

constexpr int kProgressHeadings = 2;

// MPa.
std::optional<double> plateau_of(const v1::Job& job) {
  if (job.summary().has_plateau_stress_impact_mpa()) return job.summary().plateau_stress_impact_mpa();
  if (job.progress().has_plateau_so_far_mpa()) return job.progress().plateau_so_far_mpa();
  return std::nullopt;
}

// Jobs to show in `room` rows: all, or the running ones first, in the order of the sweep.
std::vector<const Entry*> find_shown(const SweepView& view, int room) {
  std::vector<const Entry*> shown;
  for (const bool running : {true, false}) {
    for (const Entry& entry : view.jobs()) {
      if ((entry.state() == v1::Job::RUNNING) == running && static_cast<int>(shown.size()) < room)
        shown.push_back(&entry);
    }
  }
  std::sort(shown.begin(), shown.end());
  return shown;
}

std::string counts_text(const SweepView& view) {
  std::string text =
      fmt::format("{} of {} ended", view.count_ended(), job_count_text(static_cast<int>(view.jobs().size())));
  for (const v1::Job::State state :
       {v1::Job::RUNNING, v1::Job::PENDING, v1::Job::SUSPENDED, v1::Job::FAILED, v1::Job::CANCELLED}) {
    if (const int count = view.count(state); count > 0)
      text += fmt::format(", {} {}", count, v1::Job::State_Name(state));
  }
  return text;
}

std::string left_text(const SweepView& view) {
  const auto seconds = view.seconds_left();
  return seconds ? duration_text(*seconds) + " left" : std::string();
}

std::string bar_line(const SweepView& view, int width, const Terminal& terminal) {
  constexpr int kWidestBar = 100;
  constexpr int kShortestBar = 8;
  constexpr int kFigures = 26;  // room for the longest, so that the bar keeps its width
  const std::string figures = fmt::format("{:>8}  {}", percent_text(view.fraction()), left_text(view));
  const int bar = std::min(width - kFigures, kWidestBar);
  return bar < kShortestBar ? cut(figures, width) : bar_text(view.fraction(), bar, terminal) + figures;
}

std::vector<std::string> job_rows(const SweepView& view, const std::vector<const Entry*>& shown, int width) {
  const auto fields = swept_fields(view.sweep());
  std::vector<Align> columns(fields.size(), Align::right);
  columns.insert(columns.end(), {Align::left, Align::right, Align::right, Align::right, Align::left});
  Table table(columns);
  std::vector<std::string> names;
  std::vector<std::string> units;
  append_words(fields, names, units);
  names.insert(names.end(), {"state", "done", "plateau", "strain", "job"});
  double largest = 0.0;
  for (const Entry* entry : shown) largest = std::max(largest, plateau_of(entry->view.job()).value_or(0.0));
  const ShownUnit stress = unit_by_size("MPa", largest);
  units.insert(units.end(), {"", "", stress.name, "", ""});
  table.add(std::move(names));
  table.add(std::move(units));
  for (const Entry* entry : shown) {
    const v1::Job& job = entry->view.job();
    std::vector<std::string> cells;
    for (const std::string& field : fields) cells.push_back(short_value_text(job.case_(), field));
    const bool waits = entry->state() == v1::Job::PENDING;
    const auto plateau = plateau_of(job);
    const bool strained = !waits && has_strain(job.words());
    cells.insert(cells.end(),
                 {v1::Job::State_Name(entry->state()), waits ? "" : percent_text(job.progress().fraction()),
                  plateau ? number_text(stress.factor * *plateau) : "",
                  strained ? fmt::format("{:.2f}", job.progress().strain()) : "", entry->name});
    table.add(std::move(cells));
  }
  constexpr int kWhole = 10000;  // one row per job; rows without room are cut off
  std::istringstream text(table.text(0, kWhole));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(cut(line, width));
  return lines;
}

using google::protobuf::util::TimeUtil;
using Entry = SweepView::Entry;

// Estimated total seconds of a job; nothing for a waiting one.
std::optional<double> duration_of(const Entry& entry) {
  const v1::Job& job = entry.view.job();
  if (job.has_start_time() && job.has_end_time()) {
    return 1e-3 * static_cast<double>(TimeUtil::DurationToMilliseconds(job.end_time() - job.start_time()));
  }
  const v1::Progress& progress = job.progress();
  if (progress.steps_per_second() <= 0.0 || progress.step_count() <= 0) return std::nullopt;
  return static_cast<double>(progress.step_count()) / progress.steps_per_second();
}

}  // namespace

std::vector<std::string> sweep_progress_lines(const SweepView& view, int width, int height, const Terminal& terminal) {
  std::vector<std::string> lines = {cut(printable(view.sweep().name()) + "  " + counts_text(view), width),
                                    bar_line(view, width, terminal)};
  const int room = std::max(height - static_cast<int>(lines.size()) - kProgressHeadings, 1);
  const bool all = static_cast<int>(view.jobs().size()) <= room;
  const auto shown = find_shown(view, all ? room : std::max(room - 1, 1));
  const auto rows = job_rows(view, shown, width);
  lines.insert(lines.end(), rows.begin(), rows.end());
  const auto hidden = view.jobs().size() - shown.size();
  if (hidden > 0) lines.push_back(cut(fmt::format("... and {} more job{}", hidden, hidden == 1 ? "" : "s"), width));
  return lines;
}

std::string sweep_progress_line(const SweepView& view) {
  std::string line =
      fmt::format("{}  {}  {}", printable(view.sweep().name()), percent_text(view.fraction()), counts_text(view));
  if (const std::string left = left_text(view); !left.empty()) line += ", " + left;
  constexpr int kShown = 4;
  int shown = 0;
  const auto fields = swept_fields(view.sweep());
  for (const Entry& entry : view.jobs()) {
    if (entry.state() != v1::Job::RUNNING || shown == kShown) continue;
    ++shown;
    const std::string values = field_values_text(entry.view.job().case_(), fields);
    line += fmt::format("; {}: {}", printable(values.empty() ? entry.name : values),
                        percent_text(entry.view.progress().fraction()));
    if (const auto plateau = plateau_of(entry.view.job())) line += ", plateau " + quantity_text(*plateau, "MPa");
  }
  return line;
}

v1::Job::State SweepView::Entry::state() const {
  const v1::Job::State state = view.job().state();
  return state == v1::Job::JOB_STATE_UNSPECIFIED ? v1::Job::PENDING : state;
}

void SweepView::apply(const v1::WatchSweepResponse& response) {
  if (response.has_snapshot()) {
    sweep_ = response.snapshot();
    for (const std::string& name : sweep_.jobs()) find_entry(name);
  }
  if (!response.job().empty()) find_entry(response.job()).view.apply(response.event());
}

int SweepView::count(v1::Job::State state) const {
  return static_cast<int>(
      std::count_if(jobs_.begin(), jobs_.end(), [&](const Entry& entry) { return entry.state() == state; }));
}

int SweepView::count_ended() const {
  return count(v1::Job::SUCCEEDED) + count(v1::Job::FAILED) + count(v1::Job::CANCELLED);
}

bool SweepView::is_known() const {
  return !sweep_.name().empty() && std::ranges::all_of(jobs_, [](const Entry& entry) {
    return entry.view.job().state() != v1::Job::JOB_STATE_UNSPECIFIED;
  });
}

double SweepView::fraction() const {
  double done = 0.0;
  for (const Entry& entry : jobs_) done += is_final(entry.state()) ? 1.0 : entry.view.progress().fraction();
  return jobs_.empty() ? 0.0 : done / static_cast<double>(jobs_.size());
}

std::optional<double> SweepView::seconds_left() const {
  double known = 0.0;
  double left = 0.0;
  double longest = 0.0;
  int known_count = 0;
  for (const Entry& entry : jobs_) {
    if (const auto duration = duration_of(entry)) {
      known += *duration;
      ++known_count;
    }
    if (entry.state() != v1::Job::RUNNING) continue;
    left += entry.view.progress().seconds_left();
    longest = std::max(longest, entry.view.progress().seconds_left());
  }
  const int running = count(v1::Job::RUNNING);
  if (running == 0 || known_count == 0) return std::nullopt;
  left += known / known_count * count(v1::Job::PENDING);
  return std::max(left / running, longest);
}

SweepView::Entry& SweepView::find_entry(const std::string& name) {
  const auto [place, is_new] = places_.try_emplace(name, jobs_.size());
  return is_new ? jobs_.emplace_back(Entry{name, {}}) : jobs_[place->second];
}

}  // namespace cellcrush::client
