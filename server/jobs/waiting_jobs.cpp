#include "jobs/waiting_jobs.h"

namespace cellcrush::jobs {

void WaitingJobs::add(const store::QueuedJob& job) {
  auto& submission = waiting_[{-job.priority, job.submission}];
  if (submission.emplace(Rank(-job.element_steps, job.job), job).second) ++count_;
}

void WaitingJobs::remove(std::int64_t job) {
  for (auto found = waiting_.begin(); found != waiting_.end(); ++found) {
    count_ -= std::erase_if(found->second, [job](const auto& entry) { return entry.second.job == job; });
    if (!found->second.empty()) continue;
    waiting_.erase(found);
    return;
  }
}

bool WaitingJobs::is_held_back(const store::QueuedJob& job) const {
  if (job.max_parallel == 0) return false;
  const auto running = running_.find(job.sweep);
  return running != running_.end() && running->second >= job.max_parallel;
}

std::optional<store::QueuedJob> WaitingJobs::take() {
  for (auto found = waiting_.begin(); found != waiting_.end(); ++found) {
    auto& submission = found->second;
    const store::QueuedJob job = submission.begin()->second;
    if (is_held_back(job)) continue;
    submission.erase(submission.begin());
    if (submission.empty()) waiting_.erase(found);
    --count_;
    count_running(job);
    return job;
  }
  return std::nullopt;
}

void WaitingJobs::count_running(const store::QueuedJob& job) {
  if (job.max_parallel > 0) ++running_[job.sweep];
}

void WaitingJobs::give_back(const store::QueuedJob& job) {
  if (job.max_parallel == 0) return;
  const auto running = running_.find(job.sweep);
  if (--running->second == 0) running_.erase(running);
}

}  // namespace cellcrush::jobs
