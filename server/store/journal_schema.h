#pragma once

#include <cstdint>

#include "store/sqlite.h"

namespace cellcrush::store {

/// Kinds of events in the journal.
inline constexpr int kStateEvent = 1;
inline constexpr int kSampleEvent = 2;

/// Creates the tables of a new journal. Returns the seconds counted by the service clock (service_clock.h). Throws
/// ServiceError (failed_precondition) for a journal of another version.
std::int64_t prepare_journal(Database& database);

/// Throws ServiceError (failed_precondition) for a journal of another version.
void require_known_version(Database& database);

}  // namespace cellcrush::store
