#include "jobs/waiting_jobs.h"

#include <algorithm>
#include <tuple>

namespace cellcrush::jobs {

WaitingJobs::Place WaitingJobs::place_of(const store::QueuedJob& job) {
  return {.priority = -std::int64_t{job.priority},
          .owner = job.owner,
          .submission = job.submission,
          .rank = Rank(-job.element_steps, job.job)};
}

void WaitingJobs::add(const store::QueuedJob& job) {
  const Place place = place_of(job);
  if (!places_.emplace(job.job, place).second) return;
  waiting_[place.priority][place.owner][place.submission].emplace(place.rank, job);
  ++of_owner_[job.owner];
}

std::size_t WaitingJobs::count_of(const std::string& owner) const {
  const auto found = of_owner_.find(owner);
  return found == of_owner_.end() ? 0 : found->second;
}

void WaitingJobs::add_load(Load& to) const {
  const auto now = std::chrono::steady_clock::now();
  for (const auto& [job, place] : places_)
    to.longest_wait_s = std::max(to.longest_wait_s, std::chrono::duration<double>(now - place.since).count());
  for (const auto& [owner, count] : of_owner_) to.owners[owner].waiting += count;
  for (const auto& [owner, running] : running_of_owner_) {
    if (running.jobs > 0) to.owners[owner].running += static_cast<std::size_t>(running.jobs);
  }
}

void WaitingJobs::remove(std::int64_t job) {
  const auto found = places_.extract(job);
  if (found.empty()) return;
  const Place& place = found.mapped();
  const auto owners = waiting_.find(place.priority);
  const auto submissions = owners->second.find(place.owner);
  const auto submission = submissions->second.find(place.submission);
  submission->second.erase(place.rank);
  if (submission->second.empty()) submissions->second.erase(submission);
  if (submissions->second.empty()) owners->second.erase(submissions);
  if (owners->second.empty()) waiting_.erase(owners);
  const auto count = of_owner_.find(place.owner);
  if (--count->second == 0) of_owner_.erase(count);
}

bool WaitingJobs::is_at_limit(const std::string& owner) const {
  if (owner_max_running_ == 0) return false;
  const auto running = running_of_owner_.find(owner);
  return running != running_of_owner_.end() && running->second.jobs >= owner_max_running_;
}

bool WaitingJobs::is_at_limit(std::int64_t sweep, int max_parallel) const {
  if (max_parallel == 0) return false;
  const auto running = running_of_sweep_.find(sweep);
  return running != running_of_sweep_.end() && running->second >= max_parallel;
}

WaitingJobs::Limit WaitingJobs::limit_of(const store::QueuedJob& job) const {
  if (is_at_limit(job.sweep, job.max_parallel)) return Limit::sweep;
  return is_at_limit(job.owner) ? Limit::owner : Limit::none;
}

std::vector<const WaitingJobs::OfPriority::value_type*> WaitingJobs::in_turn(const OfPriority& owners) const {
  std::vector<std::tuple<int, std::int64_t, const OfPriority::value_type*>> turns;
  for (const auto& entry : owners) {
    const auto running = running_of_owner_.find(entry.first);
    const int cores = running == running_of_owner_.end() ? 0 : running->second.cores;
    turns.emplace_back(cores, entry.second.begin()->first, &entry);
  }
  std::sort(turns.begin(), turns.end());
  std::vector<const OfPriority::value_type*> out;
  out.reserve(turns.size());
  for (const auto& turn : turns) out.push_back(std::get<2>(turn));
  return out;
}

const store::QueuedJob* WaitingJobs::first_of(const Submissions& submissions) const {
  for (const auto& [number, submission] : submissions) {
    const store::QueuedJob& job = submission.begin()->second;
    if (!is_at_limit(job.sweep, job.max_parallel)) return &job;
  }
  return nullptr;
}

std::optional<store::QueuedJob> WaitingJobs::take() {
  for (const auto& [priority, owners] : waiting_) {
    for (const auto* entry : in_turn(owners)) {
      const store::QueuedJob* found = is_at_limit(entry->first) ? nullptr : first_of(entry->second);
      if (found == nullptr) continue;
      const store::QueuedJob job = *found;
      remove(job.job);
      count_running(job);
      return job;
    }
  }
  return std::nullopt;
}

void WaitingJobs::count_running(const store::QueuedJob& job, int cores) {
  if (job.max_parallel > 0) ++running_of_sweep_[job.sweep];
  Running& running = running_of_owner_[job.owner];
  ++running.jobs;
  running.cores += cores;
}

void WaitingJobs::give_back(const store::QueuedJob& job, int cores) {
  const auto of_owner = running_of_owner_.find(job.owner);
  of_owner->second.cores -= cores;
  if (--of_owner->second.jobs == 0) running_of_owner_.erase(of_owner);
  if (job.max_parallel == 0) return;
  const auto of_sweep = running_of_sweep_.find(job.sweep);
  if (--of_sweep->second == 0) running_of_sweep_.erase(of_sweep);
}

}  // namespace cellcrush::jobs
