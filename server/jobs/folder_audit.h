#pragma once

#include "jobs/executor.h"
#include "store/data_folder.h"
#include "store/journal_reader.h"

namespace cellcrush::jobs {

/// Sets aside (DataFolder::set_aside), before any job is run, what lies in jobs/ and belongs to no job of the journal,
/// so that no job takes it for its own, and the folders that no worker could use of jobs that have not ended; these
/// begin again from step 0. Each is named in the log, also what cannot be moved, which stays. Throws ServiceError when
/// jobs/ or the journal cannot be read.
void audit_job_folders(store::JournalReader& reader, const store::DataFolder& folder, Executor& executor);

}  // namespace cellcrush::jobs
