#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace cellcrush::jobs {

/// Quotas of one owner. They apply to every owner: tokens and certificates of any scope, and "local".
struct OwnerLimits {
  static constexpr int kAnyPriority = 100;

  std::int64_t queued_jobs = 0;  ///< waiting jobs; 0: no limit
  int running_jobs = 0;          ///< jobs that run at once, for the scheduler; 0: no limit
  std::int64_t disk_bytes = 0;   ///< results and journal rows; 0: no limit
  int priority = kAnyPriority;   ///< highest allowed
};

/// Refuses requests beyond an owner's quotas. Thread-safe.
class OwnerQuotas {
 public:
  explicit OwnerQuotas(const OwnerLimits& limits) : limits_(limits) {}

  /// Throws InvalidField.
  void check_priority(int priority, const std::string& field) const;

  /// Checks whether the owner, with `waiting` jobs in the queue, may queue `count` more. Calls `disk_bytes` only if
  /// there is a disk quota. Throws ServiceError: exhausted, storage_full.
  void admit(const std::string& owner, std::size_t waiting, std::size_t count,
             const std::function<std::int64_t()>& disk_bytes) const;

 private:
  OwnerLimits limits_;
};

}  // namespace cellcrush::jobs
