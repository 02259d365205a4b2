#pragma once

#include <google/protobuf/map.h>

#include <string>

#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"

namespace cellcrush::rpc {

/// Checks the common fields of create calls: request_id (at most 128 characters) and labels (at most 64; keys of 1 to
/// 63 characters, values of at most 255). Throws InvalidField; `prefix` precedes "labels".
void check_request(const std::string& request_id, const google::protobuf::Map<std::string, std::string>& labels,
                   const std::string& prefix = "");

/// Throws InvalidField unless the priority is -100 to 100.
void check_priority(int priority, const std::string& field);

/// Hash of a request and its owner, without the id: equal for a repetition of the call by the same owner.
std::string payload_hash(v1::CreateJobRequest request, const std::string& owner);
std::string payload_hash(v1::CreateSweepRequest request, const std::string& owner);

}  // namespace cellcrush::rpc
