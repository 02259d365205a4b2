#include "jobs/deletion.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "error.h"
#include "store/resource_name.h"

namespace cellcrush::jobs {
namespace {

constexpr std::size_t kJobsAtOnce = 200;
constexpr int kReadAtOnce = 500;          // jobs
constexpr std::int64_t kDeleted = 1'000;  // jobs per call

store::EndedTotals without(const store::EndedTotals& all, const store::EndedTotals& part) {
  return {all.count - part.count, all.bytes - part.bytes};
}

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

void Retention::measure(const std::function<bool()>& given_up) const {
  std::size_t count = kReadAtOnce;
  while (count == kReadAtOnce && !given_up()) {
    std::vector<store::Journal::Measured> measured;
    for (const std::int64_t job : parts_.reader.jobs_to_measure(kReadAtOnce)) {
      const auto folder = parts_.folder.job_folder(job);
      std::int64_t size = 0;
      for (const auto& path : {folder.result(), folder.history()}) {
        std::error_code failed;
        const auto bytes = std::filesystem::file_size(path, failed);
        if (!failed) size += static_cast<std::int64_t>(bytes);
      }
      measured.push_back({job, size});
    }
    parts_.journal.set_measured(measured);
    count = measured.size();
  }
}

bool Retention::enforce(const std::function<bool()>& given_up) {
  if (!has_limit()) return false;
  sweeps_.clear();
  auto totals = parts_.reader.ended_totals();
  std::int64_t deleted = 0;
  bool within_limits = false;
  std::vector<std::int64_t> jobs;  // without a sweep, to be deleted together
  store::EndedJob place;
  for (auto batch = parts_.reader.ended_jobs(place, kReadAtOnce);
       !batch.empty() && !within_limits && deleted < kDeleted && !given_up();
       batch = parts_.reader.ended_jobs(place, kReadAtOnce)) {
    for (const auto& ended : batch) {
      place = ended;
      within_limits = !is_old(ended.ended_at) && !is_too_much(totals);
      if (within_limits || deleted >= kDeleted) break;
      store::EndedTotals part{1, ended.bytes};
      if (ended.sweep == 0) {
        jobs.push_back(ended.job);
      } else {
        // Counted at the job of the sweep that ended last.
        const auto& sweep = end_of(ended.sweep);
        if (!sweep.has_ended || sweep.ended_at != ended.ended_at) continue;
        part = sweep.totals;
        delete_sweep(ended.sweep, given_up);
        sweeps_[ended.sweep].has_ended = false;
      }
      totals = without(totals, part);
      deleted += part.count;
    }
    deletion_.delete_jobs(jobs);
    for (const std::int64_t job : jobs)
      spdlog::info("{} is deleted under the --keep-ended limits", store::name_of(job));
    jobs.clear();
  }
  return deleted >= kDeleted && !within_limits;
}

bool Retention::is_too_much(const store::EndedTotals& totals) const {
  return (limits_.count > 0 && totals.count > limits_.count) || (limits_.bytes > 0 && totals.bytes > limits_.bytes);
}

bool Retention::is_old(std::int64_t ended_at) const {
  return limits_.age.count() > 0 && ended_at + limits_.age.count() < parts_.journal.service_seconds();
}

const store::SweepEnd& Retention::end_of(std::int64_t sweep) {
  auto found = sweeps_.find(sweep);
  if (found == sweeps_.end()) found = sweeps_.emplace(sweep, parts_.sweeps.end_of(sweep)).first;
  return found->second;
}

void Retention::delete_sweep(std::int64_t sweep, const std::function<bool()>& given_up) const {
  try {
    deletion_.delete_sweep(sweep, given_up);
    spdlog::info("{} is deleted with its jobs under the --keep-ended limits", store::sweep_name_of(sweep));
  } catch (const ServiceError& error) {
    // It was retried or deleted meanwhile, or the daemon ends.
    const auto kind = error.kind();
    if (kind != ServiceError::Kind::failed_precondition && kind != ServiceError::Kind::not_found &&
        kind != ServiceError::Kind::cancelled)
      throw;
  }
}

}  // namespace cellcrush::jobs
