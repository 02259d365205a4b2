#pragma once

#include <string_view>

namespace cellcrush::client {

/// case.proto with its comments, compiled by protoc at build time: a serialized google.protobuf.FileDescriptorSet.
std::string_view case_descriptor();

}  // namespace cellcrush::client
