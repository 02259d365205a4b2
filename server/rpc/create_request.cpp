#include "rpc/create_request.h"

#include "access/scope.h"
#include "error.h"
#include "store/case_hash.h"

namespace cellcrush::rpc {
namespace {

constexpr std::size_t kLongestId = 128;
constexpr std::size_t kMostLabels = 64;
constexpr std::size_t kLongestKey = 63;
constexpr std::size_t kLongestValue = 255;
constexpr int kHighestPriority = 100;

template <class Request>
std::string hash_of_payload(Request& request, const std::string& owner) {
  request.clear_request_id();
  request.clear_validate_only();
  // The form without owners, which journals of earlier versions hold.
  return store::hash_of(request) + (owner == access::kLocal ? "" : " " + owner);
}

}  // namespace

void check_request(const std::string& request_id, const google::protobuf::Map<std::string, std::string>& labels,
                   const std::string& prefix) {
  if (request_id.size() > kLongestId)
    throw InvalidField("request_id", "has " + std::to_string(request_id.size()) + " characters.", "Use at most 128.");
  const std::string field = prefix + "labels";
  if (labels.size() > kMostLabels)
    throw InvalidField(field, "are " + std::to_string(labels.size()) + ".", "Use at most 64.");
  for (const auto& [key, value] : labels) {
    if (key.empty() || key.size() > kLongestKey)
      throw InvalidField(field, "have the key \"" + key + "\", of invalid length.", "Use 1 to 63 characters.");
    if (value.size() > kLongestValue)
      throw InvalidField(field, "have a value that is too long for \"" + key + "\".", "Use at most 255 characters.");
  }
}

void check_priority(int priority, const std::string& field) {
  if (priority < -kHighestPriority || priority > kHighestPriority)
    throw InvalidField(field, "is " + std::to_string(priority) + ".",
                       "Use -100 to 100; higher priorities start first.");
}

std::string payload_hash(v1::CreateJobRequest request, const std::string& owner) {
  return hash_of_payload(request, owner);
}

std::string payload_hash(v1::CreateSweepRequest request, const std::string& owner) {
  return hash_of_payload(request, owner);
}

}  // namespace cellcrush::rpc
