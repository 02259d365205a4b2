#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// A row a job, below a heading, with a column for each of up to four fields in which jobs of one title differ; below
/// the table what is the same for all. Jobs stand below their title, which is written once for those that follow each
/// other.
std::string job_list_text(const std::vector<v1::Job>& jobs, int width = terminal_width());

}  // namespace cellcrush::client
