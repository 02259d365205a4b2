#include "jobs/folder_audit.h"

#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <map>
#include <string>

#include "error.h"
#include "store/resource_name.h"

namespace cellcrush::jobs {
namespace {

using EndWorker = std::function<bool(const store::QueuedJob& job)>;

// Entries that belong to the file system.
constexpr const char* kOfTheFileSystem = "lost+found";

// Why the folder is unusable for workers; empty if it is usable.
std::string why_unusable(const store::JobFolder& folder) {
  struct stat status {};
  if (stat(folder.root().c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) return "it is not a folder";
  if (::access(folder.root().c_str(), R_OK | W_OK | X_OK) != 0)
    return "the daemon lacks permission to read and write it";
  for (const auto& path :
       {folder.order(), folder.claim(), folder.reports(), folder.checkpoint(), folder.previous_checkpoint(),
        folder.partial_checkpoint(), folder.result(), folder.partial_result(), folder.attempt()}) {
    if (lstat(path.c_str(), &status) != 0) continue;
    const std::string name = path.filename().string();
    if (!S_ISREG(status.st_mode)) return name + " in it is not a regular file";
    if (::access(path.c_str(), R_OK | W_OK) != 0) return name + " in it is not readable and writable";
  }
  return "";
}

class FolderAudit {
 public:
  FolderAudit(store::JournalReader& reader, const store::DataFolder& folder, const EndWorker& end_worker)
      : reader_(reader), folder_(folder), end_worker_(end_worker) {
    for (const auto state : {v1::Job::PENDING, v1::Job::RUNNING, v1::Job::SUSPENDED, v1::Job::CANCELLING}) {
      for (const auto& job : reader.queued_jobs(state)) open_.emplace(job.job, job);
    }
  }

  void audit_entry(const std::string& name) {
    if (name == kOfTheFileSystem) return;
    const auto job = store::number_of("jobs/" + name);
    if (!job || !reader_.has_job(*job)) {
      set_aside(name, "it belongs to no job");
    } else if (const auto open = open_.find(*job); open != open_.end()) {
      const std::string trouble = why_unusable(folder_.job_folder(*job));
      if (!trouble.empty() && end_worker_(open->second)) set_aside(name, trouble);
    }
  }

 private:
  void set_aside(const std::string& name, const std::string& why) {
    try {
      spdlog::warn("jobs/{} was moved aside to {} because {}. Delete it when it is no longer needed.", name,
                   folder_.set_aside(name).string(), why);
    } catch (const ServiceError& error) {
      spdlog::error("jobs/{} is ignored because {}, and could not be moved aside: {} Move it away by hand.", name, why,
                    error.what());
    }
  }

  store::JournalReader& reader_;
  const store::DataFolder& folder_;
  const EndWorker& end_worker_;
  std::map<std::int64_t, store::QueuedJob> open_;  ///< jobs that have not ended
};

}  // namespace

void audit_job_folders(store::JournalReader& reader, const store::DataFolder& folder, const EndWorker& end_worker) {
  FolderAudit audit(reader, folder, end_worker);
  for (const auto& name : folder.names_in_jobs()) audit.audit_entry(name);
}

}  // namespace cellcrush::jobs
