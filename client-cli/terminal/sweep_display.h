#pragma once

#include <memory>

#include "connection/sweep_stream.h"
#include "terminal/sweep_progress.h"

namespace cellcrush::client {

/// Shows a sweep that is being watched on stdout.
class SweepDisplay : public SweepWatcher {
 public:
  /// Shows the last state that came; nothing follows.
  virtual void finish() = 0;
  [[nodiscard]] const SweepView& view() const { return view_; }

 protected:
  SweepView view_;
};

/// The display for the place: every response as JSON, a line a job redrawn in place on a terminal, else at most a line
/// a second.
std::unique_ptr<SweepDisplay> make_sweep_display(bool json, const Terminal& terminal);

}  // namespace cellcrush::client
