#pragma once

#include <filesystem>

#include "store/backup_manifest.h"

namespace cellcrush::store {

/// Backs up a data folder to a new folder (backup_format.md), even while a daemon runs on it: the journal as of one
/// moment, then the results of its jobs. Omits jobs deleted meanwhile. Records a missing or damaged result as lost and
/// continues. The backup appears complete and durable, or not at all. Throws ServiceError: not_found without a journal,
/// failed_precondition for a target that is not empty, data_loss for an unreadable journal, storage_full, internal.
BackupManifest take_backup(const std::filesystem::path& data_folder, const std::filesystem::path& target);

/// Creates a data folder from a backup at an absent or empty place. The next daemon starts a new epoch. Jobs that were
/// running wait to restart from step 0; CANCELLING jobs are CANCELLED. The folder appears complete and durable, or not
/// at all; the backup is unchanged. REQUIRES: verify_folder has found no problem in it. Throws ServiceError:
/// failed_precondition for a target that is taken, data_loss for a file that differs from the manifest, storage_full,
/// internal.
void restore_backup(const std::filesystem::path& backup, const std::filesystem::path& data_folder);

}  // namespace cellcrush::store
