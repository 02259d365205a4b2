#include "http/method.h"

#include <google/protobuf/util/json_util.h>

#include "error.h"

namespace cellcrush::http {
namespace protobuf = google::protobuf;

std::optional<Encoding> parse_content_type(std::string_view content_type) {
  const std::string_view type = content_type.substr(0, content_type.find(';'));
  if (type == "application/proto") return Encoding{false, false};
  if (type == "application/json") return Encoding{true, false};
  if (type == "application/connect+proto") return Encoding{false, true};
  if (type == "application/connect+json") return Encoding{true, true};
  return std::nullopt;
}

const char* content_type_of(const Encoding& encoding) {
  if (encoding.stream) return encoding.json ? "application/connect+json" : "application/connect+proto";
  return encoding.json ? "application/json" : "application/proto";
}

bool decode(std::string_view bytes, bool is_json, protobuf::Message& message) {
  if (!is_json) return message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
  const auto status = protobuf::util::JsonStringToMessage(std::string(bytes.empty() ? "{}" : bytes), &message);
  if (status.ok()) return true;
  throw ServiceError(ServiceError::Kind::invalid, "The request is not a " + message.GetDescriptor()->full_name() +
                                                      " in JSON: " + std::string(status.message()));
}

std::string json_of(const protobuf::Message& message) {
  std::string out;
  if (protobuf::util::MessageToJsonString(message, &out).ok()) return out;
  throw ServiceError(ServiceError::Kind::internal,
                     "A " + message.GetDescriptor()->full_name() + " cannot be written as JSON.");
}

}  // namespace cellcrush::http
