#pragma once

#include <string>
#include <vector>

#include "terminal/sweep_view.h"

namespace cellcrush::client {

/// The lines of the display that is redrawn in place: how many jobs have ended, a bar with the time left for the whole
/// sweep, then a row a job with what is varied. None is wider than `width` columns, and there are at most `height`: of
/// a larger sweep the running jobs are shown first.
std::vector<std::string> sweep_progress_lines(const SweepView& view, int width, int height, const Terminal& terminal);

/// The same in one line of any width, for a log.
std::string sweep_progress_line(const SweepView& view);

}  // namespace cellcrush::client
