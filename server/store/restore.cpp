#include <fstream>
#include <iterator>
#include <system_error>

#include "error.h"
#include "store/backup.h"
#include "store/durable_file.h"
#include "store/epoch.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "store/resource_name.h"
#include "store/staged_folder.h"

namespace cellcrush::store {
namespace {

void copy_whole(const std::filesystem::path& backup, const BackupFile& wanted, const std::filesystem::path& target) {
  const auto place = target / wanted.path;
  std::error_code error;
  std::filesystem::create_directories(place.parent_path(), error);
  if (error) throw_file_error(place.parent_path(), "created", error.value());
  const auto copied = digest_of(backup / wanted.path, place);
  if (copied.size != wanted.size || copied.sha256 != wanted.sha256) {
    throw ServiceError(ServiceError::Kind::data_loss,
                       (backup / wanted.path).string() + " has changed since it was backed up. Use another backup.");
  }
}

// Jobs restart, since a backup contains no checkpoints.
void settle_jobs(const std::filesystem::path& path, const std::string& created) {
  const std::string why = "Restarted from step 0: the data was restored from the backup of " + created +
                          ", and backups contain no checkpoints.";
  Journal journal(path, [](std::int64_t) {});
  JournalReader reader(path);
  for (const auto state : {v1::Job::PENDING, v1::Job::RUNNING, v1::Job::SUSPENDED}) {
    for (const auto& job : reader.queued_jobs(state)) {
      const auto stored = reader.find_job(job.job);
      // A job that waits for its first worker loses nothing.
      if (stored && (state == v1::Job::RUNNING || stored->job.attempt() > 0)) journal.begin_again(job.job, why);
    }
  }
  for (const auto& job : reader.queued_jobs(v1::Job::CANCELLING)) {
    StateChange cancelled;
    cancelled.state = v1::Job::CANCELLED;
    cancelled.message = "The data was restored from the backup of " + created +
                        ", taken before the job had a result. The history is kept.";
    journal.change_state(job.job, cancelled);
  }
}

}  // namespace

void restore_backup(const std::filesystem::path& backup, const std::filesystem::path& data_folder) {
  StagedFolder staged(data_folder);
  std::ifstream file(backup / kManifestName, std::ios::binary);
  const auto manifest = parse_manifest({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
  for (const auto& wanted : manifest.files) copy_whole(backup, wanted, staged.path());
  const auto path = staged.path() / "journal.sqlite";
  settle_jobs(path, manifest.created);
  {
    Database journal(path, Database::Access::single_file);
    Transaction transaction(journal);
    begin_epoch(journal, time_text_now());
    transaction.commit();
  }
  staged.publish();
}

}  // namespace cellcrush::store
