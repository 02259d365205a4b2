#include "terminal/json_text.h"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <cstdio>

namespace cellcrush::client {

std::string json_text(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  if (!status.ok()) throw std::runtime_error("a message of the server has no JSON form: " + status.ToString());
  return text;
}

void print_json(const google::protobuf::Message& message) {
  fmt::print("{}\n", json_text(message));
  std::fflush(stdout);
}

}  // namespace cellcrush::client
