#pragma once

#include <optional>
#include <string>

#include "cellcrush/v1/jobs_service.pb.h"

namespace cellcrush::rpc {

/// A field of a CreateJobRequest, outside its case, that cannot be right.
struct RequestFault {
  std::string field;
  std::string message;
  std::string remedy;
};

/// Checks the request_id (at most 128 characters) and the labels (at most 64; keys of 1 to 63 characters, values of at
/// most 255). The first fault, if there is one.
std::optional<RequestFault> check_request(const v1::CreateJobRequest& request);

/// What the request asks for, whatever its id: equal for a repetition of the same call.
std::string payload_hash(v1::CreateJobRequest request);

}  // namespace cellcrush::rpc
