#pragma once

#include <string>

#include "cellcrush/v1/job.pb.h"

namespace cellcrush::store {

/// The blob that the journal stores for a job: every field without a column of its own, except transient ones.
inline std::string job_bytes(v1::Job job) {
  job.clear_name();
  job.clear_case_();
  job.clear_progress();
  job.clear_place();
  return job.SerializeAsString();
}

}  // namespace cellcrush::store
