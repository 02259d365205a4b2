#pragma once

#include <cstdint>
#include <string>

#include "cellcrush/v1/job.pb.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// The blob that the journal stores for a job: every field without a column of its own, except transient ones.
std::string job_bytes(v1::Job job);

/// Adds a state event with this number, and makes the job's row agree. REQUIRES: a transaction is open. Throws
/// ServiceError.
void add_state(Database& database, std::int64_t number, const v1::Job& job, std::int64_t sequence);

/// Deletes all rows of a job. REQUIRES: a transaction is open. Throws ServiceError.
void remove_rows(Database& database, std::int64_t job);

}  // namespace cellcrush::store
