#pragma once

#include <string>

#include "cellcrush/v1/job.pb.h"

namespace cellcrush::store {

/// What the journal keeps of a job in one blob: all but what has a column of its own or is transient.
inline std::string job_bytes(v1::Job job) {
  job.clear_name();
  job.clear_case_();
  job.clear_progress();
  return job.SerializeAsString();
}

}  // namespace cellcrush::store
