#pragma once

#include <functional>

#include "store/job_folder.h"
#include "worker/report.pb.h"

namespace cellcrush::worker {

/// What others wish of a run.
enum class StopWish {
  none,
  suspend,  ///< leave it at a checkpoint
  cancel,   ///< end it, keep the results so far
};

/// Asked about every 50 ms.
using StopAsked = std::function<StopWish()>;

/// Runs a job, from its newest checkpoint or its beginning to its complete result.h5 or until others wish otherwise,
/// and says all of it in the folder's reports: the mesh, then samples, frames and progress, and how it ended. A run
/// that is cancelled takes a last sample and frame and ends like any other, its results kept; one that the solver
/// ends because its result is untrue leaves what was computed before, and the last good frame. One that meets a
/// shortage (shortage.h) leaves the job at its last checkpoint. A job that another solver or kind of processor began is
/// not run: its last report says that it is to begin again. Throws ServiceError when how it ended cannot be reported.
void run_job(const store::JobFolder& folder, const Order& order, const StopAsked& stop_asked);

}  // namespace cellcrush::worker
