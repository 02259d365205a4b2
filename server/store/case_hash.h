#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

namespace cellcrush::store {

/// SHA-256, in hexadecimal, of the message's deterministic serialization: equal for equal content within one build.
std::string hash_of(const google::protobuf::Message& message);

/// SHA-256 of bytes, in hexadecimal.
std::string sha256_of(std::string_view bytes);

}  // namespace cellcrush::store
