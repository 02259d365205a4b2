#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace cellcrush::client {

/// A message as protobuf JSON on one line, with the proto's own field names and with zeros written out.
std::string json_text(const google::protobuf::Message& message);

/// Prints the same on stdout at once, as a line of its own.
void print_json(const google::protobuf::Message& message);

}  // namespace cellcrush::client
