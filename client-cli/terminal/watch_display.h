#pragma once

#include <memory>

#include "connection/streams.h"
#include "terminal/progress_text.h"
#include "terminal/sweep_progress.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// Shows what is watched on stdout.
template <typename Event, typename View>
class Display : public Watcher<Event> {
 public:
  /// Shows the last state received; must be the last call.
  virtual void finish() = 0;
  [[nodiscard]] const View& view() const { return view_; }

 protected:
  View view_;
};

using JobDisplay = Display<v1::JobEvent, JobView>;
using SweepDisplay = Display<v1::WatchSweepResponse, SweepView>;

/// The display for the output: every event as JSON, an in-place display on a terminal (one line per job of a sweep),
/// else at most one line per second.
std::unique_ptr<JobDisplay> make_job_display(bool json, const Terminal& terminal);
std::unique_ptr<SweepDisplay> make_sweep_display(bool json, const Terminal& terminal);

}  // namespace cellcrush::client
