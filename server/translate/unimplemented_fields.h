#pragma once

#include <string>
#include <vector>

namespace cellcrush::translate {

/// Fields of the case that this build answers with UNIMPLEMENTED, found by asking for each of them.
std::vector<std::string> unimplemented_fields();

}  // namespace cellcrush::translate
