#include "jobs/deletion.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "error.h"
#include "store/resource_name.h"

namespace cellcrush::jobs {
namespace {

constexpr std::size_t kJobsAtOnce = 200;

void for_each_batch(const std::vector<std::int64_t>& jobs,
                    const std::function<void(const std::vector<std::int64_t>& batch)>& act) {
  for (std::size_t first = 0; first < jobs.size(); first += kJobsAtOnce) {
    const auto begin = jobs.begin() + static_cast<std::ptrdiff_t>(first);
    act({begin, begin + static_cast<std::ptrdiff_t>(std::min(kJobsAtOnce, jobs.size() - first))});
  }
}

}  // namespace

void Deletion::delete_job(std::int64_t job) const {
  parts_.journal.delete_job(job);
  remove_folders({job});
}

void Deletion::delete_jobs(const std::vector<std::int64_t>& jobs) const {
  for_each_batch(jobs, [this](const auto& batch) { remove_folders(parts_.journal.delete_ended(batch)); });
}

void Deletion::delete_sweep(std::int64_t sweep, const std::function<bool()>& given_up) const {
  parts_.journal.begin_sweep_deletion(sweep);
  if (remove_sweep(sweep, given_up)) return;
  throw ServiceError(ServiceError::Kind::cancelled, "The call ended before the deletion of " +
                                                        store::sweep_name_of(sweep) +
                                                        " was complete. The daemon finishes it in the background.");
}

void Deletion::finish_sweeps(const std::function<bool()>& given_up) const {
  for (const std::int64_t sweep : parts_.sweeps.sweeps_in_deletion()) {
    if (parts_.journal.is_being_created(sweep)) continue;
    // The jobs of an interrupted creation still wait.
    for_each_batch(parts_.sweeps.jobs_of(sweep), [this](const auto& batch) { parts_.journal.cancel_waiting(batch); });
    if (!remove_sweep(sweep, given_up)) return;
  }
}

bool Deletion::remove_sweep(std::int64_t sweep, const std::function<bool()>& given_up) const {
  auto jobs = parts_.sweeps.jobs_of(sweep);
  while (!jobs.empty()) {
    if (given_up()) return false;
    const auto rest = static_cast<std::ptrdiff_t>(jobs.size() - std::min(kJobsAtOnce, jobs.size()));
    delete_jobs({jobs.begin() + rest, jobs.end()});
    jobs.resize(static_cast<std::size_t>(rest));
  }
  parts_.journal.end_sweep_deletion(sweep);
  return true;
}

void Deletion::finish_folders() const { remove_folders(parts_.reader.deleted_jobs()); }

void Deletion::remove_folders(const std::vector<std::int64_t>& jobs) const {
  std::vector<std::int64_t> removed;
  for (const std::int64_t job : jobs) {
    try {
      parts_.folder.remove_job_folder(job);
      removed.push_back(job);
    } catch (const ServiceError& error) {
      spdlog::warn("The folder of {} could not be removed; the daemon tries again at its next start: {}",
                   store::name_of(job), error.what());
    }
  }
  if (removed.empty()) return;
  try {
    parts_.journal.note_folders_removed(removed);
  } catch (const ServiceError& error) {
    spdlog::warn(
        "The removal of {} deleted jobs' folders could not be recorded; the daemon records it at its next start: {}",
        removed.size(), error.what());
  }
}

}  // namespace cellcrush::jobs
