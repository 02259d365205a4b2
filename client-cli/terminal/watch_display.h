#pragma once

#include <chrono>
#include <memory>

#include "connection/job_stream.h"
#include "terminal/progress_text.h"

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

}  // namespace cellcrush::client
