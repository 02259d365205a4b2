#include "jobs/waiting_jobs.h"

#include <algorithm>

namespace cellcrush::jobs {

void WaitingJobs::add(std::int64_t job, const Membership& membership) { waiting_.push_back({job, membership}); }

void WaitingJobs::remove(std::int64_t job) {
  std::erase_if(waiting_, [job](const Taken& entry) { return entry.job == job; });
}

std::optional<WaitingJobs::Taken> WaitingJobs::take() {
  const auto may_run = [this](const Taken& entry) {
    const auto running = running_.find(entry.membership.sweep);
    return entry.membership.max_parallel == 0 || running == running_.end() ||
           running->second < entry.membership.max_parallel;
  };
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), may_run);
  if (found == waiting_.end()) return std::nullopt;
  const Taken taken = *found;
  waiting_.erase(found);
  if (taken.membership.max_parallel > 0) ++running_[taken.membership.sweep];
  return taken;
}

void WaitingJobs::give_back(const Taken& taken) {
  if (taken.membership.max_parallel == 0) return;
  const auto running = running_.find(taken.membership.sweep);
  if (--running->second == 0) running_.erase(running);
}

}  // namespace cellcrush::jobs
