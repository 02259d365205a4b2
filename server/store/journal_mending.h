#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "cellcrush/v1/job.pb.h"
#include "error.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// Parses what the journal stores about a job beside its case. False if the bytes are not those of a job in that state.
/// A job of an earlier version is local.
bool read_job_bytes(const std::string& bytes, std::int64_t state, v1::Job& job);

/// The error for a row of a job that was damaged since the journal was opened: data_loss.
ServiceError unreadable_entry(std::int64_t job);

/// The same for the case of a job.
ServiceError unreadable_case(std::int64_t job);

/// The error for a sweep whose request or points are damaged: data_loss.
ServiceError unreadable_sweep(std::int64_t sweep);

/// Presents a job whose journal row cannot be read as FAILED with STORE_CORRUPT, with whatever is still known.
void set_corrupt(v1::Job& job);

/// Checks every row of `jobs`, for a journal that nobody else has open. An unreadable Job is restored from its newest
/// state event and its reports. If that event is unreadable too, or the case of an unfinished job is, the job becomes
/// FAILED with STORE_CORRUPT and ends at `service_seconds` of the service clock. Every such row is logged. Also forgets
/// the changes up to a damaged one. Throws ServiceError.
void mend_jobs(Database& database, const std::filesystem::path& data_folder, std::int64_t service_seconds);

}  // namespace cellcrush::store
