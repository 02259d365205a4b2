#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace cellcrush::client {

/// A message as protobuf JSON on one line, with the proto's own field names, including zeros.
std::string json_text(const google::protobuf::Message& message);

/// Prints the same on stdout as one line, and flushes it.
void print_json(const google::protobuf::Message& message);

}  // namespace cellcrush::client
