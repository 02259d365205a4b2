#include "http/connect_error.h"

#include <array>
#include <cstdio>

#include "google/rpc/status.pb.h"
#include "web/base64.h"

namespace cellcrush::http {
namespace {

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

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04x", static_cast<unsigned>(c));
      out += escape.data();
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string unpadded_base64(const std::string& bytes) {
  std::string out = web::base64_of(bytes);
  while (out.ends_with('=')) out.pop_back();
  return out;
}

std::string details_json(const std::string& error_details) {
  google::rpc::Status status;
  if (!status.ParseFromString(error_details)) return "";
  std::string out;
  for (const auto& detail : status.details()) {
    const std::string type = detail.type_url().substr(detail.type_url().rfind('/') + 1);
    out += std::string(out.empty() ? "" : ",") + "{\"type\":" + quoted(type) + ",\"value\":\"" +
           unpadded_base64(detail.value()) + "\"}";
  }
  return out;
}

}  // namespace

const char* connect_code(grpc::StatusCode code) { return entry_of(code).name; }

unsigned http_status(grpc::StatusCode code) { return entry_of(code).status; }

std::string error_json(const grpc::Status& status) {
  std::string out = "{\"code\":\"" + std::string(connect_code(status.error_code())) +
                    "\",\"message\":" + quoted(status.error_message());
  if (const std::string details = details_json(status.error_details()); !details.empty())
    out += ",\"details\":[" + details + "]";
  return out + "}";
}

std::string end_of_stream_json(const grpc::Status& status) {
  return status.ok() ? "{}" : "{\"error\":" + error_json(status) + "}";
}

}  // namespace cellcrush::http
