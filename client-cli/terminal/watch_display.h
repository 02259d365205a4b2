#pragma once

#include <chrono>
#include <memory>

#include "connection/job_stream.h"
#include "terminal/progress_text.h"

namespace cellcrush::client {

/// Shows a job that is being watched on stdout.
class WatchDisplay : public JobWatcher {
 public:
  /// Shows the last state that came; no event follows.
  virtual void finish() = 0;
  [[nodiscard]] const JobView& view() const { return view_; }

 protected:
  JobView view_;
};

/// The display for the place: every event as JSON, a display redrawn in place on a terminal, else at most a line a
/// second.
std::unique_ptr<WatchDisplay> make_watch_display(bool json, const Terminal& terminal);

}  // namespace cellcrush::client
