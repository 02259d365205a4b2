#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/admin_service.pb.h"
#include "cellcrush/v1/job.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// One row per job below a heading, with columns for up to four fields in which jobs of one title differ. The values
/// common to all jobs follow the table. Consecutive jobs with the same title stand below it.
std::string job_list_text(const std::vector<v1::Job>& jobs, int width = terminal_width());

/// Version, age, disk and executors of a server, one a line, then the holds of its queue.
std::string status_text(const v1::Capabilities& server, const v1::Queue& queue, int width = terminal_width());

/// The holds of the queue, then one row per waiting job below its title, the next to start first. For jobs listed in
/// `jobs` the row shows up to four fields in which jobs of one title differ.
std::string queue_text(const v1::Queue& queue, const std::vector<v1::Job>& jobs, int width = terminal_width());

}  // namespace cellcrush::client
