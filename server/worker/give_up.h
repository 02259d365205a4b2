#pragma once

#include "worker/job_folder.h"
#include "worker/report_log.h"

namespace cellcrush::worker {

/// Ends a job that nobody goes on with: makes the result of what is in the reports, up to the last sample, and returns `loss`
/// with its summary; `loss` alone when nothing was reported or no result can be made. Never throws.
Final give_up(const JobFolder& folder, const Order& order, ReportLog& log, Final loss);

}  // namespace cellcrush::worker
