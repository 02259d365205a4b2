#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// A sweep in a line: "sweeps/3: 5 jobs, 1 RUNNING, 4 SUCCEEDED".
std::string sweep_line(const v1::Sweep& sweep);

/// A full description of a sweep: varied fields, states of its jobs, and their names.
std::string description_text(const v1::Sweep& sweep, int width = terminal_width());

/// One row per sweep, with a heading; common values follow the table.
std::string sweep_list_text(const std::vector<v1::Sweep>& sweeps, int width = terminal_width());

/// "1 run", "15 runs".
std::string run_count_text(int count);

/// "1 job", "15 jobs".
std::string job_count_text(int count);

/// The means and the limit of each quantity, the mesh that meets the wanted error, and the warnings of the runs.
std::string convergence_text(const v1::Convergence& convergence, int width);

}  // namespace cellcrush::client
