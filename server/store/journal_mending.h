#pragma once

#include <cstdint>
#include <string>

#include "cellcrush/v1/job.pb.h"
#include "error.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// Reads what the journal keeps of a job beside its case. False when these are not the bytes of a job in that state.
bool read_job_bytes(const std::string& bytes, std::int64_t state, v1::Job& job);

/// What is thrown for the row of a job that was damaged since the journal was opened: data_loss.
ServiceError unreadable_entry(std::int64_t job);

/// Shows a job of which the journal's entry cannot be read, with what is still known of it, as FAILED with
/// STORE_CORRUPT.
void set_corrupt(v1::Job& job);

/// Looks at every row of `jobs`, for a journal that nobody else has open. A Job that cannot be read is restored from
/// its newest state event. When that cannot be read either, or the case of a job that has not ended, the job becomes
/// FAILED with STORE_CORRUPT; it ends at `service_seconds` of the service clock. Every such row is named in the log.
/// Throws ServiceError.
void mend_jobs(Database& database, std::int64_t service_seconds);

}  // namespace cellcrush::store
