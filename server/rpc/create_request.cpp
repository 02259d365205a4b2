#include "rpc/create_request.h"

#include "store/case_hash.h"

namespace cellcrush::rpc {

std::optional<RequestFault> check_request(const v1::CreateJobRequest& request) {
  if (request.request_id().size() > 128)
    return RequestFault{"request_id", "has " + std::to_string(request.request_id().size()) + " characters.",
                        "Use at most 128."};
  if (request.labels_size() > 64)
    return RequestFault{"labels", "are " + std::to_string(request.labels_size()) + ".", "Use at most 64."};
  for (const auto& [key, value] : request.labels()) {
    if (key.empty() || key.size() > 63)
      return RequestFault{"labels", "have the key \"" + key + "\", which is empty or too long.",
                          "Use 1 to 63 characters."};
    if (value.size() > 255)
      return RequestFault{"labels", "have too long a value for \"" + key + "\".", "Use at most 255 characters."};
  }
  return std::nullopt;
}

std::string payload_hash(v1::CreateJobRequest request) {
  request.clear_request_id();
  request.clear_validate_only();
  return store::hash_of(request);
}

}  // namespace cellcrush::rpc
