#pragma once

#include "store/job_folder.h"
#include "worker/report_log.h"
#include "worker/run_job.h"

namespace cellcrush::worker {

/// Ends a job that nobody continues: makes the result from the reports, up to the last sample, and returns
/// `loss` with its summary; `loss` alone when nothing was reported or no result can be made. A wish to cancel the job
/// is acknowledged, for that is under way; at one to suspend it this leaves the job as it found it, with the step of
/// its last sample; for a shortage too, unless the job was cancelled. Never throws.
Final give_up(const store::JobFolder& folder, const Order& order, ReportLog& log, const StopAsked& stop_asked,
              Final loss);

}  // namespace cellcrush::worker
