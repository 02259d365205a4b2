#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <optional>
#include <string>
#include <string_view>

namespace cellcrush::http {

/// How the messages of a call are encoded, by its content type.
struct Encoding {
  bool json = false;
  bool stream = false;
};

/// application/proto, application/json, application/connect+proto or application/connect+json; nothing for another.
std::optional<Encoding> parse_content_type(std::string_view content_type);

/// The content type of the response.
const char* content_type_of(const Encoding& encoding);

/// The unary or server-streaming method at "/cellcrush.v1.Jobs/GetJob"; null if there is none. Finds services of
/// cellcrush.v1 and grpc.health.v1 only.
const google::protobuf::MethodDescriptor* find_method(std::string_view target);

/// Binary form of a JSON message. Throws ServiceError (invalid), naming what is wrong.
std::string binary_of(const google::protobuf::Descriptor& type, std::string_view json);

/// JSON form of a message. Throws ServiceError (internal) if it has none.
std::string json_of(const google::protobuf::Message& message);

/// JSON form of a binary message. Throws ServiceError (internal) if it cannot be parsed.
std::string json_of(const google::protobuf::Descriptor& type, const std::string& binary);

}  // namespace cellcrush::http
