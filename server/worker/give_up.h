#pragma once

#include "store/job_folder.h"
#include "store/report_log.h"
#include "worker/run_job.h"

namespace cellcrush::worker {

/// Ends a job that no worker continues: makes the result from the reports, up to the last sample, and returns `loss`
/// with its summary. Returns `loss` alone if nothing was reported or no result can be made. A request to cancel is
/// acknowledged, as the job already ends. A request to suspend leaves the job unchanged, with the step of its last
/// sample; so does a shortage, unless the job was cancelled. Never throws.
Final give_up(const store::JobFolder& folder, const Order& order, store::ReportLog& log,
              const RequestedStop& requested_stop, Final loss);

}  // namespace cellcrush::worker
