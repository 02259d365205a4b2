#pragma once

#include <memory>

#include "connection/sweep_stream.h"
#include "terminal/sweep_progress.h"

namespace cellcrush::client {

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
