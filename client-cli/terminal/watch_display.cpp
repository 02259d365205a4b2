#include "terminal/watch_display.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <utility>

#include "command_error.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// What differs between a job and a sweep.
const std::string& name_of(const JobView& view) { return view.job().name(); }
const std::string& name_of(const SweepView& view) { return view.sweep().name(); }

v1::Job::State state_of(const JobView& view) { return view.job().state(); }
v1::Job::State state_of(const SweepView&) { return v1::Job::JOB_STATE_UNSPECIFIED; }

// Whether the states of all jobs have come; the first events bring them.
bool is_known(const JobView& view) { return state_of(view) != v1::Job::JOB_STATE_UNSPECIFIED; }
bool is_known(const SweepView& view) { return view.is_known(); }

// Whether what follows the display says the same: the outcome of a job does, the table of a sweep does not.
bool is_told_later(const JobView& view) { return is_final(state_of(view)); }
bool is_told_later(const SweepView&) { return false; }

bool is_bookmark(const v1::JobEvent& event) { return event.has_bookmark(); }
bool is_bookmark(const v1::WatchSweepResponse& response) { return response.event().has_bookmark(); }

std::string line_of(const JobView& view) { return progress_line(view); }
std::string line_of(const SweepView& view) { return sweep_progress_line(view); }

std::vector<std::string> lines_of(const JobView& view, int width, const Terminal& terminal) {
  return progress_lines(view, width, terminal);
}
std::vector<std::string> lines_of(const SweepView& view, int width, const Terminal& terminal) {
  return sweep_progress_lines(view, width, terminal_height() - 1, terminal);
}

// The line above the display of a job; that of a sweep begins with its name.
std::string heading_of(const JobView& view) {
  const std::string& title = view.job().case_().title();
  return printable(name_of(view)) + (title.empty() ? "" : "  " + printable(title));
}
std::string heading_of(const SweepView&) { return {}; }

// Every event as one line of JSON.
template <typename Event, typename View>
class JsonDisplay : public Display<Event, View> {
 public:
  void on_event(const Event& event) override {
    this->view_.apply(event);
    print_json(event);
  }
  void on_break(const std::string& reason) override {
    fmt::print(stderr, "cellcrush: stream interrupted ({}); reconnecting\n", reason);
  }
  void finish() override {}
};

// Waits for the first states, but not longer than this.
constexpr auto kFirstStates = 1s;

// A line when the state changes, and otherwise at most one a second; none of what is told later.
template <typename Event, typename View>
class LineDisplay : public Display<Event, View> {
 public:
  void on_event(const Event& event) override {
    const v1::Job::State before = state_of(this->view_);
    this->view_.apply(event);
    pending_ = pending_ || !is_bookmark(event);
    if (Clock::now() - begun_ < kFirstStates && !is_known(this->view_)) return;
    if (state_of(this->view_) != before || (pending_ && Clock::now() - printed_ >= 1s)) print();
  }
  void on_break(const std::string& reason) override {
    fmt::print("{}  stream interrupted ({}); reconnecting\n", printable(name_of(this->view_)), reason);
    std::fflush(stdout);
  }
  void finish() override {
    if (pending_) print();
  }

 private:
  void print() {
    printed_ = Clock::now();
    pending_ = false;
    const std::string line = is_told_later(this->view_) ? last_ : line_of(this->view_);
    if (std::exchange(last_, line) == line) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  Clock::time_point begun_ = Clock::now();
  Clock::time_point printed_;
  std::string last_;
  bool pending_ = false;  ///< something came since the last line
};

// Lines redrawn in place at most ten times a second, each redraw in one write. The last column stays free: some
// terminals wrap when it is filled.
template <typename Event, typename View>
class LiveDisplay : public Display<Event, View> {
 public:
  explicit LiveDisplay(const Terminal& terminal) : terminal_(terminal) {}

  void on_event(const Event& event) override {
    const v1::Job::State before = state_of(this->view_);
    this->view_.apply(event);
    const std::string heading = headed_ ? "" : heading_of(this->view_);
    if (!heading.empty()) fmt::print("{}\n", cut(heading, terminal_width() - 1));
    headed_ = true;
    if (Clock::now() - begun_ < kFirstStates && !is_known(this->view_)) return;
    if (state_of(this->view_) != before || Clock::now() - drawn_ >= 100ms) finish();
  }
  void on_break(const std::string& reason) override {
    redraw_.show({cut("stream interrupted (" + reason + "); reconnecting", terminal_width() - 1)});
  }
  void finish() override {
    redraw_.show(lines_of(this->view_, terminal_width() - 1, terminal_));
    drawn_ = Clock::now();
  }

 private:
  Terminal terminal_;
  Redraw redraw_;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point drawn_;
  bool headed_ = false;
};

template <typename Event, typename View>
std::unique_ptr<Display<Event, View>> make_display(bool json, const Terminal& terminal) {
  if (json) return std::make_unique<JsonDisplay<Event, View>>();
  if (terminal.interactive) return std::make_unique<LiveDisplay<Event, View>>(terminal);
  return std::make_unique<LineDisplay<Event, View>>();
}

}  // namespace

std::unique_ptr<JobDisplay> make_job_display(bool json, const Terminal& terminal) {
  return make_display<v1::JobEvent, JobView>(json, terminal);
}

std::unique_ptr<SweepDisplay> make_sweep_display(bool json, const Terminal& terminal) {
  return make_display<v1::WatchSweepResponse, SweepView>(json, terminal);
}

}  // namespace cellcrush::client
