#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace cellcrush::store {

/// SHA-256, in hexadecimal, of the message's deterministic serialization: equal for equal content within one build.
std::string hash_of(const google::protobuf::Message& message);

}  // namespace cellcrush::store
