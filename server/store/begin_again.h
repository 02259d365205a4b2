#pragma once

#include <cstdint>
#include <string>

#include "store/sqlite.h"

namespace cellcrush::store {

/// Resets a job that is PENDING, RUNNING or SUSPENDED: deletes its samples and mesh, and adds an event that says `why`
/// it restarts from step 0. A RUNNING job becomes PENDING. Sequence numbers continue; those of the deleted samples are
/// not reused. REQUIRES: a transaction is open. Throws ServiceError: not_found, data_loss for an unreadable row, or
/// failed_precondition for a job in another state.
void begin_again(Database& database, std::int64_t job, const std::string& why);

}  // namespace cellcrush::store
