#pragma once

#include <filesystem>
#include <string_view>

namespace cellcrush::store {

/// Says that `path` cannot be `used` (used, written), with the reason of `error`, an errno. ServiceError: with the
/// shortage that the errno stands for, else internal.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view used, int error);

/// Gives a complete file its final name so that it survives a loss of power: fsync, rename, fsync of the folder.
/// Both names are in the same folder. Throws ServiceError as throw_file_error.
void publish_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace cellcrush::store
