#include "jobs/deletion.h"

#include <spdlog/spdlog.h>

#include "error.h"
#include "jobs/resource_name.h"

namespace cellcrush::jobs {
namespace {

void remove_folder(std::int64_t job, store::Journal& journal, const store::DataFolder& folder) {
  try {
    folder.remove_job_folder(job);
    journal.note_folder_removed(job);
  } catch (const ServiceError& error) {
    spdlog::warn("What {} left is removed at the daemon's next start: {}", name_of(job), error.what());
  }
}

}  // namespace

void delete_job(std::int64_t job, store::Journal& journal, const store::DataFolder& folder) {
  journal.delete_job(job);
  remove_folder(job, journal, folder);
}

void finish_deletions(store::JournalReader& reader, store::Journal& journal, const store::DataFolder& folder) {
  for (const std::int64_t job : reader.deleted_jobs()) remove_folder(job, journal, folder);
}

}  // namespace cellcrush::jobs
