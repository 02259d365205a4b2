#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/status.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cellcrush::http {

// The Connect protocol (https://connectrpc.com/docs/protocol): how it encodes messages, streams and errors.

/// How the messages of a call are encoded, by its content type.
struct Encoding {
  bool json = false;
  bool stream = false;
};

/// application/proto, application/json, application/connect+proto or application/connect+json; nothing for another.
std::optional<Encoding> parse_content_type(std::string_view content_type);

/// The content type of the response.
const char* content_type_of(const Encoding& encoding);

/// Reads a message. False if the binary form cannot be parsed. Throws ServiceError (invalid), naming what is wrong with
/// the JSON.
bool decode(std::string_view bytes, bool is_json, google::protobuf::Message& message);

/// JSON form of a message. Throws ServiceError (internal) if it has none.
std::string json_of(const google::protobuf::Message& message);

// Messages of streams: a byte of flags, the length as four bytes (big endian), the message.

inline constexpr std::uint8_t kCompressed = 1;
inline constexpr std::uint8_t kEndOfStream = 2;

/// A message with its prefix.
std::string envelope(std::uint8_t flags, std::string_view message);

/// Appends a message of `size` bytes, except for its bytes.
void begin_envelope(std::uint8_t flags, std::size_t size, std::string& to);

/// The only message in the body of a request. Throws ServiceError (invalid) if it is not exactly one.
std::string_view read_envelope(std::string_view body);

/// HTTP status of a unary call that ended with the code.
unsigned http_status(grpc::StatusCode code);

/// The error as JSON: code, message, and details from the google.rpc.Status in `error_details`.
std::string error_json(const grpc::Status& status);

/// Last envelope of a stream, without its prefix: "{}" or {"error": ...}.
std::string end_of_stream_json(const grpc::Status& status);

}  // namespace cellcrush::http
