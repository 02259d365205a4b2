#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace cellcrush::jobs {

/// What the jobs of one owner may take. Every owner is held to it: tokens and certificates of any scope, and "local".
struct OwnerLimits {
  static constexpr int kAnyPriority = 100;

  std::int64_t queued_jobs = 0;  ///< that wait; 0: any number
  int running_jobs = 0;          ///< that run at once, for the scheduler; 0: any number
  std::int64_t disk_bytes = 0;   ///< of results and rows in the journal; 0: any number
  int priority = kAnyPriority;   ///< the highest
};

/// Refuses what an owner asks for beyond his limits. Thread-safe.
class OwnerQuotas {
 public:
  explicit OwnerQuotas(const OwnerLimits& limits) : limits_(limits) {}

  /// Throws InvalidField.
  void check_priority(int priority, const std::string& field) const;

  /// Whether the owner, of whom `waiting` jobs wait, may queue `count` more; `disk_bytes` is asked only where there is
  /// a limit. Throws ServiceError: exhausted, storage_full.
  void admit(const std::string& owner, std::size_t waiting, std::size_t count,
             const std::function<std::int64_t()>& disk_bytes) const;

 private:
  OwnerLimits limits_;
};

}  // namespace cellcrush::jobs
