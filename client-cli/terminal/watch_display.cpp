#include "terminal/watch_display.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string>

#include "terminal/json_text.h"
#include "terminal/table.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// Every event as one line of JSON.
class JobJsonDisplay : public WatchDisplay {
 public:
  void on_event(const v1::JobEvent& event) override {
    view_.apply(event);
    print_json(event);
  }
  void on_break(const std::string& reason) override {
    fmt::print(stderr, "cellcrush: stream interrupted ({}); reconnecting\n", reason);
  }
  void finish() override {}
};

// A line when the state changes, and otherwise at most one a second.
class JobLineDisplay : public WatchDisplay {
 public:
  void on_event(const v1::JobEvent& event) override {
    const v1::Job::State before = view_.job().state();
    view_.apply(event);
    pending_ = !event.has_bookmark();
    if (view_.job().state() != before || (pending_ && Clock::now() - printed_ >= 1s)) print();
  }
  void on_break(const std::string& reason) override {
    fmt::print("{}  stream interrupted ({}); reconnecting\n", view_.job().name(), reason);
    std::fflush(stdout);
  }
  void finish() override {
    if (pending_) print();
  }

 private:
  void print() {
    fmt::print("{}\n", progress_line(view_));
    std::fflush(stdout);
    printed_ = Clock::now();
    pending_ = false;
  }

  Clock::time_point printed_;
  bool pending_ = false;  ///< something came since the last line
};

// Lines redrawn in place at most ten times a second, each redraw in one write.
class JobLiveDisplay : public WatchDisplay {
 public:
  explicit JobLiveDisplay(const Terminal& terminal) : terminal_(terminal) {}

  void on_event(const v1::JobEvent& event) override {
    const v1::Job::State before = view_.job().state();
    view_.apply(event);
    if (!headed_) fmt::print("{}\n", cut(heading(), terminal_width() - 1));
    headed_ = true;
    if (view_.job().state() != before || Clock::now() - drawn_ >= 100ms) draw();
  }
  void on_break(const std::string& reason) override {
    redraw_.show({cut("stream interrupted (" + reason + "); reconnecting", terminal_width() - 1)});
  }
  void finish() override { draw(); }

 private:
  [[nodiscard]] std::string heading() const {
    const v1::Job& job = view_.job();
    return printable(job.name()) + (job.case_().title().empty() ? "" : "  " + printable(job.case_().title()));
  }

  // The last column stays free: some terminals wrap when it is filled.
  void draw() {
    redraw_.show(progress_lines(view_, terminal_width() - 1, terminal_));
    drawn_ = Clock::now();
  }

  Terminal terminal_;
  Redraw redraw_;
  Clock::time_point drawn_;
  bool headed_ = false;
};

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// Every response as one line of JSON.
class SweepJsonDisplay : public SweepDisplay {
 public:
  void on_response(const v1::WatchSweepResponse& response) override {
    view_.apply(response);
    print_json(response);
  }
  void on_break(const std::string& reason) override {
    fmt::print(stderr, "cellcrush: stream interrupted ({}); reconnecting\n", reason);
  }
  void finish() override {}
};

// At most a line a second, and one at the end.
class SweepLineDisplay : public SweepDisplay {
 public:
  void on_response(const v1::WatchSweepResponse& response) override {
    view_.apply(response);
    pending_ = pending_ || !response.event().has_bookmark();
    if (pending_ && Clock::now() - printed_ >= 1s) print();
  }
  void on_break(const std::string& reason) override {
    fmt::print("{}  stream interrupted ({}); reconnecting\n", printable(view_.sweep().name()), reason);
    std::fflush(stdout);
  }
  void finish() override {
    if (pending_) print();
  }

 private:
  void print() {
    fmt::print("{}\n", sweep_progress_line(view_));
    std::fflush(stdout);
    printed_ = Clock::now();
    pending_ = false;
  }

  Clock::time_point printed_;
  bool pending_ = false;  ///< something came since the last line
};

// A line a job, redrawn in place at most ten times a second.
class SweepLiveDisplay : public SweepDisplay {
 public:
  explicit SweepLiveDisplay(const Terminal& terminal) : terminal_(terminal) {}

  void on_response(const v1::WatchSweepResponse& response) override {
    view_.apply(response);
    if (Clock::now() - drawn_ >= 100ms) draw();
  }
  // The last column stays free: some terminals wrap when it is filled.
  void on_break(const std::string& reason) override {
    redraw_.show({cut("stream interrupted (" + reason + "); reconnecting", terminal_width() - 1)});
  }
  void finish() override { draw(); }

 private:
  void draw() {
    redraw_.show(sweep_progress_lines(view_, terminal_width() - 1, terminal_height() - 1, terminal_));
    drawn_ = Clock::now();
  }

  Terminal terminal_;
  Redraw redraw_;
  Clock::time_point drawn_;
};

}  // namespace

std::unique_ptr<WatchDisplay> make_watch_display(bool json, const Terminal& terminal) {
  if (json) return std::make_unique<JobJsonDisplay>();
  if (terminal.interactive) return std::make_unique<JobLiveDisplay>(terminal);
  return std::make_unique<JobLineDisplay>();
}

std::unique_ptr<SweepDisplay> make_sweep_display(bool json, const Terminal& terminal) {
  if (json) return std::make_unique<SweepJsonDisplay>();
  if (terminal.interactive) return std::make_unique<SweepLiveDisplay>(terminal);
  return std::make_unique<SweepLineDisplay>();
}

}  // namespace cellcrush::client
