#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "store/own_folder.h"

namespace cellcrush::store {

/// A file of a backup.
struct BackupFile {
  std::string path;  ///< "journal.sqlite", "jobs/N/result.h5" or "jobs/N/history"
  std::uint64_t size = 0;
  std::string sha256;  ///< in hexadecimal
};

/// Contents of a backup (backup_format.md).
struct BackupManifest {
  std::string created;  ///< time of the journal's copy, "2026-11-23T09:15:02Z"
  std::vector<BackupFile> files;
  std::vector<std::string> lost;  ///< results missing or damaged at the time of the backup, one sentence each
};

/// Name of the manifest in a backup.
inline constexpr const char* kManifestName = "MANIFEST";

std::string text_of(const BackupManifest& manifest);

/// Reads the manifest of a backup. Throws ServiceError (data_loss) for a text that text_of did not write, and for one
/// that names a file or job twice.
BackupManifest read_manifest(const std::filesystem::path& backup);

/// SHA-256 of a file, in hexadecimal, and its size. Also copies the file to `copy` unless that is empty. Reads little
/// more than `most` bytes. Throws ServiceError.
BackupFile digest_of(const std::filesystem::path& file, const std::filesystem::path& copy = {},
                     std::uint64_t most = std::numeric_limits<std::uint64_t>::max(), LastLink link = LastLink::refused);

/// "2026-11-23T09:15:02Z".
std::string time_text_now();

}  // namespace cellcrush::store
