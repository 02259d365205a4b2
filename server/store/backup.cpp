#include "store/backup.h"

#include <fcntl.h>

#include <cerrno>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

#include "error.h"
#include "store/durable_file.h"
#include "store/job_folder.h"
#include "store/job_rows.h"
#include "store/job_state.h"
#include "store/journal.h"
#include "store/journal_mending.h"
#include "store/journal_reader.h"
#include "store/journal_schema.h"
#include "store/resource_name.h"
#include "store/result_seal.h"
#include "store/sqlite.h"
#include "store/staged_folder.h"
#include "store/verification.h"

namespace cellcrush::store {
namespace {

constexpr const char* kJournalName = "journal.sqlite";

// A job with files that a restored daemon serves.
struct ServedJob {
  std::int64_t number = 0;
  bool has_result = false;
};

std::vector<ServedJob> find_served(Database& journal) {
  Statement read(journal, "SELECT number, state, job, samples FROM jobs ORDER BY number");
  std::vector<ServedJob> out;
  while (read.step()) {
    v1::Job job;
    if (!read_job_bytes(read.bytes(2), read.integer(1), job)) continue;
    const bool has_result = is_terminal(job.state()) && job.has_summary();
    // A restore cancels a job that is CANCELLING; others begin again.
    const bool has_history = read.integer(3) > 0 && (is_terminal(job.state()) || job.state() == v1::Job::CANCELLING);
    if (has_result || has_history) out.push_back({read.integer(0), has_result});
  }
  return out;
}

// The results and histories of a journal's jobs, beside its copy.
class FileBackup {
 public:
  FileBackup(const std::filesystem::path& data_folder, const std::filesystem::path& target, Database& live)
      : data_folder_(data_folder), target_(target), live_(live) {}

  void copy(const ServedJob& served, BackupManifest& manifest) {
    const std::int64_t job = served.number;
    const std::size_t before = manifest.files.size();
    std::string problem = "the result is damaged.";
    try {
      const JobFolder folder(data_folder_ / name_of(job));
      const bool has_history = copy_file(job, folder.history(), "history", manifest) ||
                               (!served.has_result && copy_file(job, folder.reports(), "history", manifest));
      // One that was CANCELLING may have a result by now.
      if (has_history && !served.has_result) return;
      if (!copy_file(job, folder.result(), "result.h5", manifest))
        problem = "the file is missing.";
      else if (read_seal(target_ / manifest.files.back().path) != Seal::broken)
        return;
      else
        manifest.files.pop_back();
    } catch (const ServiceError& error) {
      if (error.kind() == ServiceError::Kind::storage_full) throw;
      problem = error.what();
    }
    static_cast<void>(remove_own(target_ / name_of(job) / "result.h5"));
    // A job's rows are deleted before its folder.
    if (has_job(live_, job)) {
      manifest.lost.push_back(name_of(job) + " has no result in this backup: " + problem);
      return;
    }
    static_cast<void>(remove_own(target_ / name_of(job)));
    manifest.files.resize(before);
    deleted_.push_back(job);
  }

  /// Jobs that were deleted while the backup was made.
  [[nodiscard]] const std::vector<std::int64_t>& deleted() const { return deleted_; }

 private:
  // False if it is absent.
  bool copy_file(std::int64_t job, const std::filesystem::path& from, const char* name, BackupManifest& manifest) {
    if (!find_own(from)) return false;
    std::error_code error;
    std::filesystem::create_directories(target_ / name_of(job), error);
    if (error) throw_file_error(target_ / name_of(job), "created", error.value());
    auto file =
        digest_of(from, target_ / name_of(job) / name, std::numeric_limits<std::uint64_t>::max(), LastLink::of_owner);
    file.path = name_of(job) + "/" + name;
    manifest.files.push_back(std::move(file));
    return true;
  }

  const std::filesystem::path& data_folder_;
  const std::filesystem::path& target_;
  Database& live_;
  std::vector<std::int64_t> deleted_;
};

void remove_deleted(Database& journal, const std::vector<std::int64_t>& deleted) {
  if (deleted.empty()) return;
  Transaction transaction(journal);
  for (const std::int64_t job : deleted) remove_rows(journal, job);
  transaction.commit();
}

void write_manifest(const BackupManifest& manifest, const std::filesystem::path& folder) {
  const auto path = folder / kManifestName;
  OpenFile file = open_own(path, O_WRONLY | O_CREAT | O_EXCL);
  write_all(file, path, text_of(manifest));
  if (!file.close()) throw_file_error(path, "written", errno);
}

void copy_whole(const std::filesystem::path& backup, const BackupFile& wanted, const std::filesystem::path& target) {
  const auto place = target / wanted.path;
  std::error_code error;
  std::filesystem::create_directories(place.parent_path(), error);
  if (error) throw_file_error(place.parent_path(), "created", error.value());
  const auto copied = digest_of(backup / wanted.path, place, wanted.size);
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

BackupManifest take_backup(const std::filesystem::path& given, const std::filesystem::path& target) {
  const auto data_folder = canonical_of(given);
  const auto live_path = data_folder / kJournalName;
  if (!is_own_file(live_path)) {
    throw ServiceError(ServiceError::Kind::not_found,
                       given.string() +
                           " is not a data folder: it contains no journal.sqlite. Give the --data folder of "
                           "the daemon.");
  }
  StagedFolder staged(target);
  Database live(live_path);
  require_known_version(live);
  BackupManifest manifest;
  manifest.created = time_text_now();
  const auto copy_path = staged.path() / kJournalName;
  { Database(copy_path, Database::Access::single_file).copy_from(live); }
  {
    // The copy keeps the journal mode of the original until it is reopened.
    Database copy(copy_path, Database::Access::single_file);
    FileBackup files(data_folder, staged.path(), live);
    for (const ServedJob& job : find_served(copy)) files.copy(job, manifest);
    remove_deleted(copy, files.deleted());
    for (auto& problem : problems_of_rows(copy)) manifest.lost.push_back(std::move(problem));
  }
  manifest.files.push_back(digest_of(copy_path));
  manifest.files.back().path = kJournalName;
  write_manifest(manifest, staged.path());
  staged.publish();
  return manifest;
}

void restore_backup(const std::filesystem::path& given, const std::filesystem::path& data_folder) {
  StagedFolder staged(data_folder);
  const auto backup = canonical_of(given);
  const auto manifest = read_manifest(backup);
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
