#include "terminal/sweep_display.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "terminal/json_text.h"
#include "terminal/redraw.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

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

std::unique_ptr<SweepDisplay> make_sweep_display(bool json, const Terminal& terminal) {
  if (json) return std::make_unique<SweepJsonDisplay>();
  if (terminal.interactive) return std::make_unique<SweepLiveDisplay>(terminal);
  return std::make_unique<SweepLineDisplay>();
}

}  // namespace cellcrush::client
