#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <vector>

namespace cellcrush::testing {

/// What a client built for the old files would miss in the present pool, one sentence each: messages, fields,
/// values of enums and methods that are gone or have another name, number, type, label, oneof or streaming. What was
/// removed is no break if its number and name are reserved.
std::vector<std::string> api_breaks(const std::vector<const google::protobuf::FileDescriptor*>& old_files,
                                    const google::protobuf::DescriptorPool& now);

}  // namespace cellcrush::testing
