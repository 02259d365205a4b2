#pragma once

#include <string>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// Reads a case from protobuf text. Throws CommandError (refused) with every error that was found, one a line, as
/// "FILE:LINE:COLUMN: message" (counted from 1), misspelt fields with the name that may have been meant.
v1::Case parse_text_case(const std::string& text, const std::string& file);

}  // namespace cellcrush::client
