#pragma once

#include <string>
#include <vector>

#include "terminal/sweep_view.h"

namespace cellcrush::client {

/// The lines of the in-place display: the number of ended jobs, a bar with the remaining time of the sweep, then one
/// row per job with its varied values. None is wider than `width`, and there are at most `height`; a larger sweep shows
/// its running jobs first.
std::vector<std::string> sweep_progress_lines(const SweepView& view, int width, int height, const Terminal& terminal);

/// The same in one line of any width, for a log.
std::string sweep_progress_line(const SweepView& view);

}  // namespace cellcrush::client
