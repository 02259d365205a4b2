#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/sample.h"

namespace cellcrush {

/// Samples in their memory representation, for the same build. A run that is resumed from a checkpoint needs those
/// taken before.
std::string bytes_of(std::span<const Sample> samples);

/// Returns nothing if the bytes are not samples.
std::optional<std::vector<Sample>> samples_of(std::string_view bytes);

}  // namespace cellcrush
