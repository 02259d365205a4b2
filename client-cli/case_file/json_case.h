#pragma once

#include <string>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// Reads a case from protobuf JSON (field names as in the proto, or in lowerCamelCase). Throws CommandError (refused)
/// with the path of the invalid field, as "FILE: path: message".
v1::Case parse_json_case(const std::string& text, const std::string& file);

}  // namespace cellcrush::client
