#pragma once

#include <filesystem>
#include <string_view>

namespace cellcrush::store {

/// Says that `path` cannot be `used` (used, written), with the reason of `error`, an errno. ServiceError: with the
/// shortage that the errno stands for, else internal.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view used, int error);

/// Opens a regular file for reading, and never waits for it as for a FIFO. Returns the descriptor, which is the
/// caller's. Throws ServiceError: internal when it is another kind of file or cannot be opened.
int open_to_read(const std::filesystem::path& path);

/// Gives a complete file its final name so that it survives a loss of power: fsync, rename, fsync of the folder.
/// Both names are in the same folder. Throws ServiceError as throw_file_error.
void publish_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace cellcrush::store
