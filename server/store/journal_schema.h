#pragma once

#include <cstdint>
#include <filesystem>

#include "store/sqlite.h"

namespace cellcrush::store {

/// Creates the tables of a new journal, or upgrades one of the version before. Returns the seconds counted by the
/// service clock (ServiceClock). Throws ServiceError (failed_precondition) for a journal of another version.
std::int64_t prepare_journal(Database& database, const std::filesystem::path& data_folder);

/// Throws ServiceError (failed_precondition) for a journal of another version.
void require_known_version(Database& database);

}  // namespace cellcrush::store
