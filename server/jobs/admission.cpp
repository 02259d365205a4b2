#include "jobs/admission.h"

#include <fmt/format.h>

#include <cmath>

#include "allotment.h"
#include "error.h"
#include "jobs/queues.h"

namespace cellcrush::jobs {
namespace {

constexpr std::int64_t kMebibyte = 1024 * 1024;

std::string mebibytes(std::int64_t bytes) { return std::to_string(bytes / kMebibyte) + " MiB"; }

}  // namespace

Admission::Admission(const Parts& parts, const Limits& limits) : parts_(parts), limits_(limits) {
  if (limits_.job_memory_bytes == 0) limits_.job_memory_bytes = usable_memory();
}

void Admission::check_time_limit(double seconds, const std::string& field) const {
  if (!std::isfinite(seconds) || seconds < 0.0)
    throw InvalidField(field, fmt::format("is {}.", seconds),
                       "Use a positive number of seconds, or 0 for the daemon's limit only.");
  const double most = limits_.job_time.count();
  if (most > 0.0 && seconds > most) {
    throw InvalidField(field, fmt::format("is {} s; this daemon allows a job at most {} s.", seconds, most),
                       fmt::format("Use at most {}, or start the daemon with a higher --max-job-time.", most));
  }
}

std::int64_t Admission::memory_of_job(std::int64_t most_bytes, const std::function<std::int64_t()>& predict) const {
  return most_bytes <= limits_.job_memory_bytes ? most_bytes : predict();
}

Admission::Place::~Place() {
  if (admission_ == nullptr) return;
  const MutexLock lock(admission_->mutex_);
  const auto of_owner = admission_->admitted_.find(owner_);
  of_owner->second -= count_;
  if (of_owner->second == 0) admission_->admitted_.erase(of_owner);
}

Admission::Place Admission::admit(const std::string& owner, std::size_t count, std::int64_t memory_bytes) {
  if (draining_) {
    throw ServiceError(ServiceError::Kind::unavailable,
                       "The daemon is shutting down and accepts no new jobs. Submit again after it restarts.");
  }
  if (memory_bytes > limits_.job_memory_bytes) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       "The run would need about " + mebibytes(memory_bytes) + " of memory; the limit per job is " +
                           mebibytes(limits_.job_memory_bytes) +
                           ". Use fewer cells or elements_per_wall, or a machine with more memory.");
  }
  if (const auto low = low_disk())
    throw ServiceError(ServiceError::Kind::storage_full, *low + " Free disk space or delete jobs, then submit again.");
  const MutexLock lock(mutex_);
  std::size_t waiting = parts_.queues.waiting_count();
  for (const auto& [name, jobs] : admitted_) waiting += jobs;
  if (static_cast<std::int64_t>(waiting + count) > limits_.queued_jobs) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       "The queue holds " + std::to_string(waiting) + " waiting jobs; " + std::to_string(count) +
                           " more would exceed the limit of " + std::to_string(limits_.queued_jobs) +
                           ". Wait until some have started, or start the daemon with a higher --max-queued-jobs.");
  }
  const auto admitted = admitted_.find(owner);
  const std::size_t of_owner = admitted == admitted_.end() ? 0 : admitted->second;
  check_quotas(owner, parts_.queues.waiting_count(owner) + of_owner, count);
  admitted_[owner] += count;
  return {*this, owner, count};
}

std::optional<std::string> Admission::low_disk() const {
  const std::int64_t free = parts_.folder.free_bytes();
  if (free >= limits_.free_disk_bytes) return std::nullopt;
  return "The data folder's disk is nearly full: " + mebibytes(free) + " are free, below the reserve of " +
         mebibytes(limits_.free_disk_bytes) + " (--min-free-disk).";
}

void Admission::check_priority(int priority, const std::string& field) const {
  if (priority <= limits_.owner.priority) return;
  throw InvalidField(
      field, fmt::format("is {}; this daemon allows at most {}.", priority, limits_.owner.priority),
      fmt::format("Use at most {}, or start the daemon with a higher --owner-max-priority.", limits_.owner.priority));
}

void Admission::check_quotas(const std::string& owner, std::size_t waiting, std::size_t count) const {
  if (limits_.owner.queued_jobs > 0 && static_cast<std::int64_t>(waiting + count) > limits_.owner.queued_jobs) {
    throw ServiceError(
        ServiceError::Kind::exhausted,
        fmt::format("{} has {} waiting jobs; {} more would exceed the quota of {} per owner. Wait until some have "
                    "started, cancel some, or start the daemon with a higher --owner-max-queued.",
                    owner, waiting, count, limits_.owner.queued_jobs));
  }
  if (limits_.owner.disk_bytes == 0) return;
  if (const std::int64_t bytes = parts_.reader.bytes_of_owner(owner); bytes >= limits_.owner.disk_bytes) {
    throw ServiceError(ServiceError::Kind::storage_full,
                       fmt::format("The jobs of {} use {} MiB; the quota per owner is {} MiB. Delete ended jobs or "
                                   "sweeps, or start the daemon with a higher --owner-max-disk.",
                                   owner, bytes / kMebibyte, limits_.owner.disk_bytes / kMebibyte));
  }
}

}  // namespace cellcrush::jobs
