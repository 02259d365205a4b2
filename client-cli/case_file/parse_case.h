#pragma once

#include <string>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// Reads a case from protobuf text. Throws CommandError (refused) with all errors found, one per line as
/// "FILE:LINE:COLUMN: message" (counted from 1), with suggestions for misspelt fields.
v1::Case parse_text_case(const std::string& text, const std::string& file);

/// Reads a case from protobuf JSON (field names as in the proto, or in lowerCamelCase). Throws CommandError (refused)
/// with the path of the invalid field, as "FILE: path: message".
v1::Case parse_json_case(const std::string& text, const std::string& file);

}  // namespace cellcrush::client
