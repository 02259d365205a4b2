#pragma once

#include <filesystem>
#include <optional>

#include "cellcrush/state.h"

namespace cellcrush::bench {

/// Writes every field of a state. The file is in its place only once it is whole. Throws std::runtime_error when it
/// cannot be written.
void save_state(const std::filesystem::path& file, const State& state);

/// The state of a file that this same program wrote; nothing when there is no such file. Throws std::runtime_error on a
/// file that is cut short.
std::optional<State> load_state(const std::filesystem::path& file);

}  // namespace cellcrush::bench
