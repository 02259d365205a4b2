#pragma once

#include <string_view>

namespace cellcrush::client {

/// case.proto with its comments, as protoc has read it: a serialized google.protobuf.FileDescriptorSet.
/// Made at build time.
std::string_view case_descriptor();

}  // namespace cellcrush::client
