#pragma once

#include <chrono>
#include <memory>

#include "connection/streams.h"
#include "terminal/progress_text.h"
#include "terminal/sweep_progress.h"

namespace cellcrush::client {

/// Shows a watched job on stdout.
class WatchDisplay : public JobWatcher {
 public:
  /// Shows the last state received; must be the last call.
  virtual void finish() = 0;
  [[nodiscard]] const JobView& view() const { return view_; }

 protected:
  JobView view_;
};

/// The display for the output: every event as JSON, an in-place display on a terminal, else at most one line per
/// second.
std::unique_ptr<WatchDisplay> make_watch_display(bool json, const Terminal& terminal);

/// Shows a watched sweep on stdout.
class SweepDisplay : public SweepWatcher {
 public:
  /// Shows the last state received; must be the last call.
  virtual void finish() = 0;
  [[nodiscard]] const SweepView& view() const { return view_; }

 protected:
  SweepView view_;
};

/// The display for the output: every response as JSON, one line per job redrawn in place on a terminal, else at most
/// one line per second.
std::unique_ptr<SweepDisplay> make_sweep_display(bool json, const Terminal& terminal);

}  // namespace cellcrush::client
