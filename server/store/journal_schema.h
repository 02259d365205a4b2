#pragma once

#include <cstdint>
#include <filesystem>

#include "store/sqlite.h"

namespace cellcrush::store {

/// Creates the tables of a new journal, or upgrades one of the version before. Returns the seconds counted by the
/// service clock (service_clock.h). Throws ServiceError (failed_precondition) for a journal of another version.
std::int64_t prepare_journal(Database& database, const std::filesystem::path& data_folder);

/// Turns a journal of version 6, which had the samples as events, into one of version 7: those of an ended job go to
/// its `history` in the data folder; those of other jobs are in their reports. REQUIRES: a transaction is open. Throws
/// ServiceError; a repetition begins again.
void upgrade_from_version_6(Database& database, const std::filesystem::path& data_folder);

/// Throws ServiceError (failed_precondition) for a journal of another version.
void require_known_version(Database& database);

}  // namespace cellcrush::store
