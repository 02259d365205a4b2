#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "jobs/owner_quotas.h"
#include "mutex.h"
#include "store/data_folder.h"
#include "store/journal_reader.h"

namespace cellcrush::jobs {

class Queues;

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

  /// Refuses all jobs from now on.
  void drain() { draining_ = true; }

  /// Checks the time limit that a job requests. Throws InvalidField.
  void check_time_limit(double seconds, const std::string& field) const;

  /// Checks the requested priority against the owner's limit. Throws InvalidField.
  void check_priority(int priority, const std::string& field) const { quotas_.check_priority(priority, field); }

  /// Memory of a job, of which `most_bytes` is an upper bound. `predict` is called only if that bound exceeds the
  /// limit.
  [[nodiscard]] std::int64_t memory_of_job(std::int64_t most_bytes, const std::function<std::int64_t()>& predict) const;

  /// Reserves places for this many jobs of the owner, the largest of which needs this much memory. Throws ServiceError:
  /// unavailable while draining, exhausted beyond a limit or a quota, storage_full.
  [[nodiscard]] Place admit(const std::string& owner, std::size_t count, std::int64_t memory_bytes);

  /// Why the disk has too little room for jobs, as a sentence; nothing if it has enough. Throws ServiceError.
  [[nodiscard]] std::optional<std::string> low_disk() const;

 private:
  Parts parts_;
  Limits limits_;
  OwnerQuotas quotas_;
  std::atomic<bool> draining_ = false;
  Mutex mutex_;
  std::map<std::string, std::size_t> admitted_
      CELLCRUSH_GUARDED_BY(mutex_);  ///< jobs admitted but not yet queued, by owner
};

}  // namespace cellcrush::jobs
