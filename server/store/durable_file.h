#pragma once

#include <filesystem>

namespace cellcrush::store {

/// Gives a complete file its final name so that it survives a loss of power: fsync, rename, fsync of the folder.
/// Both names are in the same folder. Throws ServiceError: storage_full or internal.
void publish_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace cellcrush::store
