#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "mutex.h"
#include "store/data_folder.h"
#include "store/journal_reader.h"

namespace cellcrush::jobs {

class Queues;

/// Quotas of one owner. They apply to every owner: tokens and certificates of any scope, and "local".
struct OwnerLimits {
  static constexpr int kAnyPriority = 100;

  std::int64_t queued_jobs = 0;  ///< waiting jobs; 0: no limit
  int running_jobs = 0;          ///< jobs that run at once, for the scheduler; 0: no limit
  std::int64_t disk_bytes = 0;   ///< results and journal rows; 0: no limit
  int priority = kAnyPriority;   ///< highest allowed
};

/// Decides whether the daemon takes new jobs. Thread-safe.
class Admission {
 public:
  struct Limits {
    std::int64_t queued_jobs = 100'000;
    std::int64_t job_memory_bytes = 0;            ///< limit for the predicted memory of a job; 0: memory of the machine
    std::int64_t free_disk_bytes = 0;             ///< to keep free in the data folder
    std::chrono::duration<double> job_time{0.0};  ///< wall-clock limit of a job; 0: none
    OwnerLimits owner;
  };

  /// Sources of the current usage; all outlive this object.
  struct Parts {
    const store::DataFolder& folder;
    store::JournalReader& reader;
    Queues& queues;
  };

  /// Admitted jobs that are not in the queue yet. While this object lives they count as waiting, so that concurrent
  /// calls cannot share the remainder of a limit.
  class Place {
   public:
    Place(Admission& admission, std::string owner, std::size_t count)
        : admission_(&admission), owner_(std::move(owner)), count_(count) {}
    ~Place();
    Place(Place&& other) noexcept
        : admission_(std::exchange(other.admission_, nullptr)), owner_(std::move(other.owner_)), count_(other.count_) {}
    Place& operator=(Place&&) = delete;

   private:
    Admission* admission_;
    std::string owner_;
    std::size_t count_;
  };

  Admission(const Parts& parts, const Limits& limits);

  [[nodiscard]] const Limits& limits() const { return limits_; }

  /// Refuses all jobs from now on.
  void drain() { draining_ = true; }

  /// Checks the time limit that a job requests. Throws InvalidField.
  void check_time_limit(double seconds, const std::string& field) const;

  /// Checks the requested priority against the owner's limit. Throws InvalidField.
  void check_priority(int priority, const std::string& field) const;

  /// Memory of a job, of which `most_bytes` is an upper bound. `predict` is called only if that bound exceeds the
  /// limit.
  [[nodiscard]] std::int64_t memory_of_job(std::int64_t most_bytes, const std::function<std::int64_t()>& predict) const;

  /// Reserves places for this many jobs of the owner, the largest of which needs this much memory. Throws ServiceError:
  /// unavailable while draining, exhausted beyond a limit or a quota, storage_full.
  [[nodiscard]] Place admit(const std::string& owner, std::size_t count, std::int64_t memory_bytes);

  /// Why the disk has too little room for jobs, as a sentence; nothing if it has enough. Throws ServiceError.
  [[nodiscard]] std::optional<std::string> low_disk() const;

 private:
  /// Checks whether the owner, with `waiting` jobs in the queue, may queue `count` more. Throws ServiceError.
  void check_quotas(const std::string& owner, std::size_t waiting, std::size_t count) const;

  Parts parts_;
  Limits limits_;
  std::atomic<bool> draining_ = false;
  Mutex mutex_;
  std::map<std::string, std::size_t> admitted_
      CELLCRUSH_GUARDED_BY(mutex_);  ///< jobs admitted but not yet queued, by owner
};

}  // namespace cellcrush::jobs
