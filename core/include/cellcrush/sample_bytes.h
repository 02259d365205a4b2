#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/sample.h"

namespace cellcrush {

/// Samples as they stand, for the same build: what a run that goes on from a checkpoint has to remember of those
/// before.
std::string bytes_of(std::span<const Sample> samples);

/// Nothing when the bytes are no samples.
std::optional<std::vector<Sample>> samples_of(std::string_view bytes);

}  // namespace cellcrush
