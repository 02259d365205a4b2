#pragma once

#include <memory>

#include "cellcrush/v1/jobs_service.pb.h"
#include "store/job_folder.h"

namespace cellcrush::jobs {

/// All frames of a job computed so far: from its result or, while it has none, from the reports of its workers. Keeps
/// the file open, so that a job that ends or is deleted meanwhile does not matter. Not thread-safe.
class FrameSeries {
 public:
  virtual ~FrameSeries() = default;
  [[nodiscard]] virtual const v1::StreamFramesResponse::FrameTimes& times() const = 0;
  /// Fastest in ascending order. Throws ServiceError if it cannot be read.
  /// REQUIRES: an index below the number of times.
  virtual v1::FieldFrame frame(int index) = 0;
};

/// Null if the job has neither a result nor reports. Throws ServiceError if they cannot be read.
std::unique_ptr<FrameSeries> open_frame_series(const store::JobFolder& folder);

}  // namespace cellcrush::jobs
