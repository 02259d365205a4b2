#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/job.pb.h"

namespace cellcrush::client {

/// How a job ended or stands: a heading, then for a SUCCEEDED job its plateau stresses with theory beside them, energy
/// and contact; for a FAILED one the cause, what happened and the remedy.
std::string outcome_text(const v1::Job& job);

/// All that is known of a job, for a reader.
std::string description_text(const v1::Job& job);

/// A line a job, with a heading.
std::string job_list_text(const std::vector<v1::Job>& jobs);

/// A name as the server knows it: "jobs/NAME" for a NAME without a slash.
std::string job_name(const std::string& name);

}  // namespace cellcrush::client
