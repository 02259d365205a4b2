#include "jobs/owner_quotas.h"

#include <fmt/format.h>

#include "error.h"

namespace cellcrush::jobs {
namespace {

constexpr std::int64_t kQuotaUnit = 1024 * 1024;

}  // namespace

void OwnerQuotas::check_priority(int priority, const std::string& field) const {
  if (priority <= limits_.priority) return;
  throw InvalidField(
      field, fmt::format("is {}; this daemon allows at most {}.", priority, limits_.priority),
      fmt::format("Use at most {}, or start the daemon with a higher --owner-max-priority.", limits_.priority));
}

void OwnerQuotas::admit(const std::string& owner, std::size_t waiting, std::size_t count,
                        const std::function<std::int64_t()>& disk_bytes) const {
  if (limits_.queued_jobs > 0 && static_cast<std::int64_t>(waiting + count) > limits_.queued_jobs) {
    throw ServiceError(
        ServiceError::Kind::exhausted,
        fmt::format("{} has {} waiting jobs; {} more would exceed the quota of {} per owner. Wait until some have "
                    "started, cancel some, or start the daemon with a higher --owner-max-queued.",
                    owner, waiting, count, limits_.queued_jobs));
  }
  if (limits_.disk_bytes == 0) return;
  if (const std::int64_t bytes = disk_bytes(); bytes >= limits_.disk_bytes) {
    throw ServiceError(ServiceError::Kind::storage_full,
                       fmt::format("The jobs of {} use {} MiB; the quota per owner is {} MiB. Delete ended jobs or "
                                   "sweeps, or start the daemon with a higher --owner-max-disk.",
                                   owner, bytes / kQuotaUnit, limits_.disk_bytes / kQuotaUnit));
  }
}

}  // namespace cellcrush::jobs
