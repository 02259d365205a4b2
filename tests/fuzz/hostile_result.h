#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace cellcrush::fuzz {

/// A number that stands in the files beside the result, and never in a result.
inline constexpr double kOfAnotherFile = 777.0;

/// Writes other.h5 and other.bin, full of kOfAnotherFile, into the folder.
void write_other_files(const std::filesystem::path& folder);

/// How a part is replaced.
using Choice = std::span<const std::uint8_t, 5>;

/// Puts something else in the place of datasets, groups and an attribute of the result at `path`, which lies beside the
/// other files: nothing, a link of some kind, a dataset that is made of other files, one of another shape, type or
/// storage, or one that says it holds what was never written.
void replace_parts(const std::filesystem::path& path, std::span<const Choice> choices);

}  // namespace cellcrush::fuzz
