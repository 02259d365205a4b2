#pragma once

#include <cstdint>

#include "store/sqlite.h"

namespace cellcrush::store {

/// Kinds of events in the journal.
inline constexpr int kStateEvent = 1;
inline constexpr int kSampleEvent = 2;

/// The first version that has sweeps.
inline constexpr std::int64_t kVersionWithSweeps = 2;

/// Creates the tables of a new journal, and those that an earlier version lacks. Returns the seconds counted by the
/// service clock (service_clock.h). Throws ServiceError (failed_precondition) for a journal of a later version.
std::int64_t prepare_journal(Database& database);

/// Version of the tables; 0 without tables.
std::int64_t journal_version(Database& database);

/// Throws ServiceError (failed_precondition) for a journal of a later version.
void require_known_version(Database& database);

}  // namespace cellcrush::store
