#pragma once

#include <functional>

#include "store/job_folder.h"
#include "store/report.pb.h"

namespace cellcrush::worker {

/// A request to stop a run.
enum class StopRequest {
  none,
  suspend,  ///< checkpoint the job and exit
  cancel,   ///< end the job and keep its results so far
};

/// Polled about every 50 ms.
using RequestedStop = std::function<StopRequest()>;

/// Runs a job from its newest checkpoint, or from step 0, until result.h5 is complete or a request stops it. The
/// folder's reports receive the mesh, then samples, frames and progress, and finally the outcome. A cancelled run takes
/// a last sample and frame, and keeps its results. A run that the solver stops because its result is untrue keeps
/// earlier results and the last good frame. `order` is as its file has it. A run that meets a shortage (shortage.h)
/// leaves the job at its last checkpoint. A job that another solver or kind of processor began is not run; its final
/// report requests a restart. Throws ServiceError if the outcome cannot be reported.
void run_job(const store::JobFolder& folder, Order order, const RequestedStop& requested_stop);

}  // namespace cellcrush::worker
