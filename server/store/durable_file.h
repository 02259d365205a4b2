#pragma once

#include <filesystem>
#include <string_view>

namespace cellcrush::store {

/// Says that `path` cannot be `used` (used, written), with the reason of `error`, an errno. ServiceError: storage_full where
/// there is no space left, else internal.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view used, int error);

/// Gives a complete file its final name so that it survives a loss of power: fsync, rename, fsync of the folder.
/// Both names are in the same folder. Throws ServiceError: storage_full or internal.
void publish_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace cellcrush::store
