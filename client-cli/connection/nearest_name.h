#pragma once

#include <string>

#include "cellcrush/v1/cases_service.grpc.pb.h"
#include "cellcrush/v1/jobs_service.grpc.pb.h"
#include "cellcrush/v1/sweeps_service.grpc.pb.h"

namespace cellcrush::client {

/// A name on the server that may be meant by `name`, which does not exist: for "preset:NAME" a preset with a similar
/// name; else the job or sweep with the same number ("job/3", "jobs3"), or a preset that is named without its prefix.
/// Empty when there is none. Calls that fail count as not found.
std::string find_nearest_name(const std::string& name, v1::Cases::Stub& cases, v1::Jobs::Stub& jobs,
                              v1::Sweeps::Stub& sweeps);

}  // namespace cellcrush::client
