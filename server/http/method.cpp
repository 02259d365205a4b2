#include "http/method.h"

#include <google/protobuf/util/json_util.h>

#include <memory>

#include "error.h"

namespace cellcrush::http {
namespace {

namespace protobuf = google::protobuf;

std::unique_ptr<protobuf::Message> new_message(const protobuf::Descriptor& type) {
  return std::unique_ptr<protobuf::Message>(protobuf::MessageFactory::generated_factory()->GetPrototype(&type)->New());
}

}  // namespace

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

const protobuf::MethodDescriptor* find_method(std::string_view target) {
  const auto slash = target.find('/', 1);
  if (!target.starts_with('/') || slash == std::string_view::npos) return nullptr;
  const std::string service(target.substr(1, slash - 1));
  if (!service.starts_with("cellcrush.v1.") && service != "grpc.health.v1.Health") return nullptr;
  const auto* found = protobuf::DescriptorPool::generated_pool()->FindServiceByName(service);
  const auto* out = found == nullptr ? nullptr : found->FindMethodByName(std::string(target.substr(slash + 1)));
  return out == nullptr || out->client_streaming() ? nullptr : out;
}

std::string binary_of(const protobuf::Descriptor& type, std::string_view json) {
  const auto message = new_message(type);
  const std::string text(json.empty() ? "{}" : json);
  const auto status = protobuf::util::JsonStringToMessage(text, message.get());
  if (!status.ok()) {
    throw ServiceError(ServiceError::Kind::invalid,
                       "The request is not a " + type.full_name() + " in JSON: " + std::string(status.message()));
  }
  return message->SerializeAsString();
}

std::string json_of(const protobuf::Message& message) {
  std::string out;
  if (protobuf::util::MessageToJsonString(message, &out).ok()) return out;
  throw ServiceError(ServiceError::Kind::internal,
                     "A " + message.GetDescriptor()->full_name() + " cannot be written as JSON.");
}

std::string json_of(const protobuf::Descriptor& type, const std::string& binary) {
  const auto message = new_message(type);
  if (message->ParseFromString(binary)) return json_of(*message);
  throw ServiceError(ServiceError::Kind::internal, "A " + type.full_name() + " cannot be parsed.");
}

}  // namespace cellcrush::http
