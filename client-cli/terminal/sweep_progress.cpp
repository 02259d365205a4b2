#include "terminal/sweep_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "exit_code.h"
#include "results/field_value.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

constexpr int kLongestBar = 40;
constexpr int kShortestBar = 6;
constexpr int kStateWidth = 10;

using Entry = SweepView::Entry;

v1::JobState state_of(const Entry& entry) {
  // A job of which nothing has come yet waits.
  const v1::JobState state = entry.view.job().state();
  return state == v1::JOB_STATE_UNSPECIFIED ? v1::PENDING : state;
}

std::string plateau_text(const v1::Job& job) {
  const bool ended = job.summary().has_plateau_stress_impact_mpa();
  if (!ended && !job.progress().has_plateau_so_far_mpa()) return {};
  return fmt::format("plateau {} MPa", number_text(ended ? job.summary().plateau_stress_impact_mpa()
                                                         : job.progress().plateau_so_far_mpa()));
}

std::set<std::string> varied_fields(const v1::Sweep& sweep) {
  std::set<std::string> fields;
  for (const v1::SweepAxis& axis : sweep.axes()) fields.insert(axis.field());
  for (const v1::SweepPoint& point : sweep.points()) {
    for (const auto& [field, value] : point.fields()) fields.insert(field);
  }
  return fields;
}

std::string padded(const std::string& text, int width) {
  const std::string fitted = cut(text, width);
  return fitted + std::string(static_cast<std::size_t>(width - display_width(fitted)), ' ');
}

// The columns of the lines: what a job is called, and how much room its bar has.
struct Columns {
  int name = 0;
  int bar = 0;
};

std::string name_text(const SweepView& view, const Entry& entry, bool with_name) {
  const std::string values = varied_values_text(view.sweep(), entry.view.job());
  if (values.empty()) return printable(entry.name);
  return with_name ? values + "  " + printable(entry.name) : values;
}

std::string job_line(const SweepView& view, const Entry& entry, const Columns& columns, bool with_name,
                     const Terminal& terminal) {
  const v1::Progress& progress = entry.view.progress();
  const v1::JobState state = state_of(entry);
  std::string line =
      padded(name_text(view, entry, with_name), columns.name) + "  " + padded(v1::JobState_Name(state), kStateWidth);
  if (state == v1::PENDING) return line;
  if (columns.bar >= kShortestBar) line += "  " + bar_text(progress.fraction(), columns.bar, terminal);
  line += fmt::format(" {:>7}", percent_text(progress.fraction()));
  if (!entry.view.job().case_().lattice().has_frame()) line += fmt::format("  strain {:.2f}", progress.strain());
  if (const std::string plateau = plateau_text(entry.view.job()); !plateau.empty()) line += "  " + plateau;
  return line;
}

// Jobs to show in `room` lines: all, or the running ones before the others, in the order of the sweep.
std::vector<const Entry*> find_shown(const SweepView& view, int room) {
  std::vector<const Entry*> shown;
  for (const bool running : {true, false}) {
    for (const Entry& entry : view.jobs()) {
      if ((state_of(entry) == v1::RUNNING) == running && static_cast<int>(shown.size()) < room) shown.push_back(&entry);
    }
  }
  std::sort(shown.begin(), shown.end());
  return shown;
}

std::string counts_text(const SweepView& view) {
  std::string text = fmt::format("{} of {} jobs ended", view.count_ended(), view.jobs().size());
  for (const v1::JobState state : {v1::RUNNING, v1::PENDING, v1::SUSPENDED, v1::FAILED, v1::CANCELLED}) {
    if (const int count = view.count(state); count > 0) text += fmt::format(", {} {}", count, v1::JobState_Name(state));
  }
  return text;
}

}  // namespace

void SweepView::apply(const v1::WatchSweepResponse& response) {
  if (response.has_snapshot()) {
    sweep_ = response.snapshot();
    for (const std::string& name : sweep_.jobs()) find_entry(name);
  }
  if (!response.job().empty()) find_entry(response.job()).view.apply(response.event());
}

int SweepView::count(v1::JobState state) const {
  return static_cast<int>(
      std::count_if(jobs_.begin(), jobs_.end(), [&](const Entry& entry) { return state_of(entry) == state; }));
}

int SweepView::count_ended() const { return count(v1::SUCCEEDED) + count(v1::FAILED) + count(v1::CANCELLED); }

SweepView::Entry& SweepView::find_entry(const std::string& name) {
  const auto found = std::find_if(jobs_.begin(), jobs_.end(), [&](const Entry& entry) { return entry.name == name; });
  return found == jobs_.end() ? jobs_.emplace_back(Entry{name, {}}) : *found;
}

std::string varied_values_text(const v1::Sweep& sweep, const v1::Job& job) {
  std::string text;
  for (const std::string& field : varied_fields(sweep)) {
    const std::string value = field_value_text(job.case_(), field);
    if (!value.empty()) text += fmt::format("{}{}={}", text.empty() ? "" : " ", last_part(field), value);
  }
  return printable(text);
}

std::vector<std::string> sweep_progress_lines(const SweepView& view, int width, int height, const Terminal& terminal) {
  const auto widest = [&](bool with_name) {
    int widest_name = 0;
    for (const Entry& entry : view.jobs()) {
      widest_name = std::max(widest_name, display_width(name_text(view, entry, with_name)));
    }
    return widest_name;
  };
  // Behind the bar stand a percentage, a strain and a plateau stress.
  constexpr int kFigures = 8 + 13 + 18;
  const auto bar_room = [&](int name) { return width - name - 2 - kStateWidth - 2 - kFigures; };
  const bool with_name = bar_room(widest(true)) >= kLongestBar / 2;
  const int name = std::min(widest(with_name), std::max(width / 3, 8));
  const Columns columns{name, std::min(bar_room(name), kLongestBar)};
  std::vector<std::string> lines = {cut(printable(view.sweep().name()) + "  " + counts_text(view), width)};
  const int room = std::max(height - 2, 1);
  const auto shown = find_shown(view, room);
  for (const Entry* entry : shown) {
    const std::string line = job_line(view, *entry, columns, with_name, terminal);
    // A colour's escape sequences take no columns; a line with a bar fits by its making.
    lines.push_back(columns.bar >= kShortestBar ? line : cut(line, width));
  }
  if (shown.size() < view.jobs().size()) {
    lines.push_back(cut(fmt::format("... and {} more jobs", view.jobs().size() - shown.size()), width));
  }
  return lines;
}

std::string sweep_progress_line(const SweepView& view) {
  std::string line = printable(view.sweep().name()) + "  " + counts_text(view);
  constexpr int kShown = 4;
  int shown = 0;
  for (const Entry& entry : view.jobs()) {
    if (state_of(entry) != v1::RUNNING || shown == kShown) continue;
    ++shown;
    line += fmt::format("  {} {}", name_text(view, entry, false), percent_text(entry.view.progress().fraction()));
    if (const std::string plateau = plateau_text(entry.view.job()); !plateau.empty()) line += " " + plateau;
  }
  return line;
}

}  // namespace cellcrush::client
