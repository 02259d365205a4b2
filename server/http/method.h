#pragma once

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

/// Reads a message. False if the binary form cannot be parsed. Throws ServiceError (invalid), naming what is wrong with
/// the JSON.
bool decode(std::string_view bytes, bool is_json, google::protobuf::Message& message);

/// JSON form of a message. Throws ServiceError (internal) if it has none.
std::string json_of(const google::protobuf::Message& message);

}  // namespace cellcrush::http
