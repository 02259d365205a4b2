#pragma once

#include <cstdint>

#include "store/sqlite.h"

namespace cellcrush::store {

/// Deletes all rows of a job. REQUIRES: a transaction is open. Throws ServiceError.
void remove_rows(Database& database, std::int64_t job);

}  // namespace cellcrush::store
