#pragma once

#include <functional>

#include "store/data_folder.h"
#include "store/journal_reader.h"

namespace cellcrush::jobs {

/// Cleans up jobs/ before any job runs. Sets aside (DataFolder::set_aside) entries that belong to no job of the
/// journal, so that no job mistakes them for its own. Also sets aside unusable folders of unfinished jobs, which
/// restart from step 0: `end_worker` ends the job's worker first, or returns false to leave the folder as it is. The
/// log names each one, including those that cannot be moved and stay. Throws ServiceError if jobs/ or the journal
/// cannot be read.
void audit_job_folders(store::JournalReader& reader, const store::DataFolder& folder,
                       const std::function<bool(const store::QueuedJob& job)>& end_worker);

}  // namespace cellcrush::jobs
