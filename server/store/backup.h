#pragma once

#include <filesystem>

#include "store/backup_manifest.h"

namespace cellcrush::store {

/// Backs up the data folder, also while a daemon runs on it, to a new folder (backup_format.md): the journal as it is
/// at one moment, then the results of its jobs. A job that is deleted meanwhile is not in the backup. A result that is
/// missing or damaged is noted as lost, and the rest is backed up. The folder appears complete and durable, or not at
/// all. Throws ServiceError: not_found without a journal, failed_precondition for a target that is not empty, data_loss
/// for a journal that cannot be read, storage_full, internal.
BackupManifest take_backup(const std::filesystem::path& data_folder, const std::filesystem::path& target);

/// Makes a data folder of a backup, in a place that is not there or empty, for the next daemon: a new epoch begins,
/// jobs that ran wait to be begun again from step 0, and those that were CANCELLING are CANCELLED. The folder appears
/// complete and durable, or not at all; the backup stays as it is. REQUIRES: verify_folder has found no problem in it.
/// Throws ServiceError: failed_precondition for a target that is taken, data_loss for a file that is not that of the
/// manifest, storage_full, internal.
void restore_backup(const std::filesystem::path& backup, const std::filesystem::path& data_folder);

}  // namespace cellcrush::store
