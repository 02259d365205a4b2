#pragma once

#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "open_file.h"

namespace cellcrush::store {

// The daemon's own folders: data folder, backups, and the folder shared with a cluster. Each part of a path is opened
// below the one before, and none may be a link. A link in such a folder therefore never leads reading, writing or
// deleting out of it. Paths that a user names are made canonical first. Failures leave their errno, which is ELOOP for
// a link.

/// What open_own leaves in errno for a FIFO, a device or a folder in place of a file.
inline constexpr int kNotRegular = EMEDIUMTYPE;

/// Whether the last part of a path may be a link.
enum class LastLink {
  refused,
  of_owner,  ///< if it belongs to this user, who made it with `cellcrushd import --link`
};

/// The folder that a user names, without links; as it was named if it is not there.
std::filesystem::path canonical_of(const std::filesystem::path& given);

/// Opens a regular file or, with O_DIRECTORY, a folder, for this process only. Never blocks, as a FIFO would. A new
/// file is its owner's only.
OpenFile try_open_own(const std::filesystem::path& path, int flags, LastLink link = LastLink::refused);

/// The entry itself, not what a link names.
std::optional<struct stat> find_own(const std::filesystem::path& path);

/// Whether there is a regular file.
bool is_own_file(const std::filesystem::path& path);

/// The next three return 0 or the errno. A new folder is its owner's only.
int make_own_folder(const std::filesystem::path& path);
int rename_own(const std::filesystem::path& from, const std::filesystem::path& to);
/// Removes an entry with its contents, unless it is absent. Fails with EXDEV at a folder of another file system.
int remove_own(const std::filesystem::path& path);

/// Names of the entries of a folder. Throws ServiceError.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// Throws ServiceError (failed_precondition), which begins with `shown` and names the remedy, if the folder belongs to
/// another user than this one or root, or others can write in it.
void require_own_folder(const std::filesystem::path& folder, const std::string& shown);

/// A path by which a library opens this file again, whatever its name refers to by now.
std::filesystem::path path_of(const OpenFile& file);

}  // namespace cellcrush::store
