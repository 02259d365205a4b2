#pragma once

#include <filesystem>

#include "open_file.h"

namespace cellcrush::store {

/// Takes the exclusive lock of an open file or folder, at `path`, for as long as it stays open. False if another
/// process holds it. Throws ServiceError (failed_precondition), with the file system and what to do, if that has no
/// locks; SQLite needs those of fcntl as well.
bool try_lock(const OpenFile& file, const std::filesystem::path& path);

}  // namespace cellcrush::store
