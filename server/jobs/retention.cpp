#include "jobs/retention.h"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <system_error>

#include "error.h"
#include "store/resource_name.h"

namespace cellcrush::jobs {
namespace {

constexpr int kReadAtOnce = 500;          // jobs
constexpr std::int64_t kDeleted = 1'000;  // jobs per call

store::EndedTotals without(const store::EndedTotals& all, const store::EndedTotals& part) {
  return {all.count - part.count, all.bytes - part.bytes};
}

}  // namespace

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
