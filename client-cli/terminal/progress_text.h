#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// State of a watched job: the newest of everything in its events.
class JobView {
 public:
  void apply(const v1::JobEvent& event);

  [[nodiscard]] const v1::Job& job() const { return job_; }
  [[nodiscard]] const v1::Progress& progress() const { return job_.progress(); }

 private:
  v1::Job job_;
};

/// A bar `width` columns wide, filled to `fraction`.
std::string bar_text(double fraction, int width, const Terminal& terminal);

/// The lines of the in-place display, at most `width` columns wide. A narrow terminal gets more lines.
std::vector<std::string> progress_lines(const JobView& view, int width, const Terminal& terminal);

/// The same in one line of any width, for a log.
std::string progress_line(const JobView& view);

}  // namespace cellcrush::client
