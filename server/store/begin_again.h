#pragma once

#include <cstdint>
#include <string>

#include "store/sqlite.h"

namespace cellcrush::store {

/// Takes back what workers have made of a job that is PENDING, RUNNING or SUSPENDED: its samples and its mesh go, and
/// an event says `why` it begins again from step 0. A job that is RUNNING becomes PENDING. Sequence numbers count on;
/// those of the samples are not used again. REQUIRES: a transaction is open. Throws ServiceError: not_found, data_loss
/// for a row that cannot be read, or failed_precondition for a job in another state.
void begin_again(Database& database, std::int64_t job, const std::string& why);

}  // namespace cellcrush::store
