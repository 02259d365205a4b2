#include "http/connect_protocol.h"

#include <absl/strings/escaping.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/type_resolver_util.h>

#include <algorithm>
#include <array>
#include <memory>

#include "error.h"
#include "google/rpc/status.pb.h"
#include "log_format.h"
#include "rpc/request_weight.h"

namespace cellcrush::http {
namespace {

namespace protobuf = google::protobuf;

constexpr std::size_t kPrefix = 5;
constexpr std::ptrdiff_t kMostObjects = 250'000;
constexpr const char* kTypes = "type.googleapis.com";

struct CodeEntry {
  const char* name;
  unsigned status;
};

// By gRPC code.
constexpr std::array kCodes = {
    CodeEntry{"ok", 200},
    CodeEntry{"canceled", 499},
    CodeEntry{"unknown", 500},
    CodeEntry{"invalid_argument", 400},
    CodeEntry{"deadline_exceeded", 504},
    CodeEntry{"not_found", 404},
    CodeEntry{"already_exists", 409},
    CodeEntry{"permission_denied", 403},
    CodeEntry{"resource_exhausted", 429},
    CodeEntry{"failed_precondition", 400},
    CodeEntry{"aborted", 409},
    CodeEntry{"out_of_range", 400},
    CodeEntry{"unimplemented", 501},
    CodeEntry{"internal", 500},
    CodeEntry{"unavailable", 503},
    CodeEntry{"data_loss", 500},
    CodeEntry{"unauthenticated", 401},
};

const CodeEntry& entry_of(grpc::StatusCode code) {
  const auto index = static_cast<std::size_t>(code);
  return kCodes[index < kCodes.size() ? index : static_cast<std::size_t>(grpc::StatusCode::UNKNOWN)];
}

std::string details_json(const std::string& error_details) {
  google::rpc::Status status;
  if (!status.ParseFromString(error_details)) return "";
  return absl::StrJoin(status.details(), ",", [](std::string* out, const google::protobuf::Any& detail) {
    const std::string value = absl::Base64Escape(detail.value());
    absl::StrAppend(out, "{\"type\":", json_string(detail.type_url().substr(detail.type_url().rfind('/') + 1)),
                    ",\"value\":\"", value.substr(0, value.find('=')), "\"}");
  });
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

bool decode(std::string_view bytes, bool is_json, protobuf::Message& message) {
  if (!is_json) return rpc::parse_within_limits(bytes, message);
  // Each takes microseconds to convert.
  if (const auto objects = std::ranges::count(bytes, '{'); objects > kMostObjects) {
    throw ServiceError(ServiceError::Kind::invalid,
                       absl::StrCat("The request has ", objects, " objects in JSON. Use at most ", kMostObjects,
                                    ", or send it in binary form."));
  }
  // First to bytes, which are checked before they become a message.
  static const std::unique_ptr<protobuf::util::TypeResolver> resolver(
      protobuf::util::NewTypeResolverForDescriptorPool(kTypes, protobuf::DescriptorPool::generated_pool()));
  const std::string& type = message.GetDescriptor()->full_name();
  std::string binary;
  const auto status = protobuf::util::JsonToBinaryString(resolver.get(), std::string(kTypes) + "/" + type,
                                                         std::string(bytes.empty() ? "{}" : bytes), &binary);
  if (status.ok()) return rpc::parse_within_limits(binary, message);
  throw ServiceError(ServiceError::Kind::invalid,
                     "The request is not a " + type + " in JSON: " + std::string(status.message()));
}

std::string json_of(const protobuf::Message& message) {
  std::string out;
  if (protobuf::util::MessageToJsonString(message, &out).ok()) return out;
  throw ServiceError(ServiceError::Kind::internal,
                     "A " + message.GetDescriptor()->full_name() + " cannot be written as JSON.");
}

void begin_envelope(std::uint8_t flags, std::size_t size, std::string& to) {
  to.reserve(to.size() + kPrefix + size);
  to += static_cast<char>(flags);
  for (const unsigned shift : {24U, 16U, 8U, 0U}) to += static_cast<char>((size >> shift) & 0xFFU);
}

std::string envelope(std::uint8_t flags, std::string_view message) {
  std::string out;
  out.reserve(kPrefix + message.size());
  begin_envelope(flags, message.size(), out);
  return out.append(message);
}

std::string_view read_envelope(std::string_view body) {
  std::size_t size = 0;
  for (std::size_t i = 1; i < kPrefix && i < body.size(); ++i) size = size << 8U | static_cast<unsigned char>(body[i]);
  if (body.size() < kPrefix || size != body.size() - kPrefix) {
    throw ServiceError(ServiceError::Kind::invalid,
                       "The body of a streaming call must be one envelope: a byte of flags, the length of the message "
                       "as four bytes (big endian), and the message.");
  }
  return body.substr(kPrefix);
}

unsigned http_status(grpc::StatusCode code) { return entry_of(code).status; }

std::string error_json(const grpc::Status& status) {
  std::string out = "{\"code\":\"" + std::string(entry_of(status.error_code()).name) +
                    "\",\"message\":" + json_string(status.error_message());
  if (const std::string details = details_json(status.error_details()); !details.empty())
    out += ",\"details\":[" + details + "]";
  return out + "}";
}

std::string end_of_stream_json(const grpc::Status& status) {
  return status.ok() ? "{}" : "{\"error\":" + error_json(status) + "}";
}

}  // namespace cellcrush::http
