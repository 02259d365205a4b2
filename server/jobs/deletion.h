#pragma once

#include <cstdint>

#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"

namespace cellcrush::jobs {

/// Deletes a job that has ended, with all it left. Throws ServiceError: not_found, or failed_precondition when it has
/// not ended. A folder that cannot be removed is left to finish_deletions.
void delete_job(std::int64_t job, store::Journal& journal, const store::DataFolder& folder);

/// Removes the folders that earlier deletions left behind.
void finish_deletions(store::JournalReader& reader, store::Journal& journal, const store::DataFolder& folder);

}  // namespace cellcrush::jobs
