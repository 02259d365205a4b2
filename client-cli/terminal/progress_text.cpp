#include "terminal/progress_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "command_error.h"
#include "terminal/case_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

constexpr std::string_view kColourOn = "\x1b[36m";
constexpr std::string_view kColourOff = "\x1b[0m";

std::string stress_at(const char* where, double stress) {
  const ShownUnit unit = unit_by_size("MPa", stress);
  return fmt::format("{} {:6.{}f} {}", where, unit.factor * stress, unit.factor > 1.0 ? 2 : 3, unit.name);
}

std::string repeat(std::string_view piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

std::vector<std::string> progress_fields(const JobView& view) {
  const v1::Progress& progress = view.progress();
  std::vector<std::string> fields;
  if (!has_strain(view.job().words())) {
    fields = {fmt::format("step {} of {}", count_text(progress.step()), count_text(progress.step_count()))};
  } else {
    fields = {fmt::format("strain {:.3f}", progress.strain()), stress_at("impact", progress.stress_impact_mpa()),
              stress_at("support", progress.stress_support_mpa())};
  }
  if (progress.has_plateau_so_far_mpa()) fields.push_back(stress_at("plateau", progress.plateau_so_far_mpa()));
  if (progress.steps_per_second() > 0) fields.push_back(number_text(progress.steps_per_second()) + " steps/s");
  return fields;
}

std::string remaining_text(const JobView& view) {
  const v1::Progress& progress = view.progress();
  if (view.job().state() != v1::Job::RUNNING || progress.steps_per_second() <= 0)
    return v1::Job::State_Name(view.job().state());
  return duration_text(progress.seconds_left()) + " left";
}

// Rank of a state in a job's life; the display never goes back to an earlier state.
int rank_of(v1::Job::State state) {
  switch (state) {
    case v1::Job::JOB_STATE_UNSPECIFIED: return 0;
    case v1::Job::PENDING: return 1;
    case v1::Job::RUNNING:
    case v1::Job::SUSPENDED:
    case v1::Job::CANCELLING: return 2;
    default: return 3;
  }
}

}  // namespace

void JobView::apply(const v1::JobEvent& event) {
  switch (event.event_case()) {
    case v1::JobEvent::kSnapshot: job_ = event.snapshot().job(); break;
    case v1::JobEvent::kState: {
      // A state event may lack the case and the progress that are already known.
      const v1::Job known = job_;
      // The states before the snapshot's are sent again.
      if (rank_of(event.state().state()) < rank_of(known.state())) break;
      job_ = event.state();
      if (!job_.has_progress()) *job_.mutable_progress() = known.progress();
      if (!job_.has_case_() && known.has_case_()) {
        *job_.mutable_case_() = known.case_();
        *job_.mutable_words() = known.words();
      }
      break;
    }
    case v1::JobEvent::kProgress: *job_.mutable_progress() = event.progress(); break;
    case v1::JobEvent::kSample: {
      v1::Progress& progress = *job_.mutable_progress();
      progress.set_strain(event.sample().strain());
      progress.set_step(event.sample().step());
      progress.set_stress_impact_mpa(event.sample().stress_impact_mpa());
      progress.set_stress_support_mpa(event.sample().stress_support_mpa());
      break;
    }
    default: break;
  }
  // The last progress was reported a moment before the end, and a snapshot of an ended job has none.
  if (job_.state() == v1::Job::SUCCEEDED) job_.mutable_progress()->set_fraction(1.0);
}

std::string bar_text(double fraction, int width, const Terminal& terminal) {
  static constexpr std::array kEighths = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const double share = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  if (!terminal.unicode) {
    const int full = static_cast<int>(share * (width - 2));
    return fmt::format("[{}{}]", repeat("#", full), repeat(".", width - 2 - full));
  }
  const int eighths = static_cast<int>(share * 8 * width);
  const int full = eighths / 8;
  const std::string_view part = kEighths[static_cast<std::size_t>(eighths % 8)];
  const std::string filled = repeat("█", full) + std::string(part);
  const std::string rest = repeat("░", width - full - (part.empty() ? 0 : 1));
  return terminal.colour ? fmt::format("{}{}{}{}", kColourOn, filled, kColourOff, rest) : filled + rest;
}

std::vector<std::string> progress_lines(const JobView& view, int width, const Terminal& terminal) {
  constexpr int kLongestBar = 100;
  constexpr int kShortestBar = 8;
  if (view.job().state() == v1::Job::PENDING) return {cut("waiting for a worker", width)};
  const std::string percent = fmt::format("{:>8}", percent_text(view.progress().fraction()));
  const std::string remaining = remaining_text(view);
  // Room for the longest duration, so that the bar keeps its width.
  const int bar = std::min(width - display_width(percent) - 2 - std::max(display_width(remaining), 16), kLongestBar);
  std::vector<std::string> lines;
  const std::string figures = fmt::format("{}  {}", percent, remaining);
  lines.push_back(bar < kShortestBar ? cut(figures, width)
                                     : bar_text(view.progress().fraction(), bar, terminal) + figures);
  std::string line;
  for (const std::string& field : progress_fields(view)) {
    if (!line.empty() && display_width(line) + 2 + display_width(field) > width) {
      lines.push_back(cut(line, width));
      line.clear();
    }
    if (!line.empty()) line += "  ";
    line += field;
  }
  lines.push_back(cut(line, width));
  return lines;
}

std::string progress_line(const JobView& view) {
  std::string line = printable(view.job().name()) + "  ";
  if (view.job().state() == v1::Job::PENDING) return line + "PENDING: waiting for a worker";
  if (is_final(view.job().state())) return line + v1::Job::State_Name(view.job().state());
  line += fmt::format("{:>7}", percent_text(view.progress().fraction()));
  for (const std::string& field : progress_fields(view)) line.append("  ").append(field);
  return line.append("  ").append(remaining_text(view));
}

}  // namespace cellcrush::client
