#pragma once

#include <string>

#include "cellcrush/v1/cases_service.grpc.pb.h"
#include "cellcrush/v1/jobs_service.grpc.pb.h"
#include "cellcrush/v1/sweeps_service.grpc.pb.h"

namespace cellcrush::client {

/// An existing name similar to `name`, which does not exist. For "preset:NAME" a similar preset; otherwise the job or
/// sweep with the same number ("job/3", "jobs3"), or a preset given without its prefix. Empty if there is none. Failed
/// calls count as not found.
std::string find_nearest_name(const std::string& name, v1::Cases::Stub& cases, v1::Jobs::Stub& jobs,
                              v1::Sweeps::Stub& sweeps);

}  // namespace cellcrush::client
