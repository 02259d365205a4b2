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

class Scheduler;

/// Decides whether the daemon takes new jobs. Thread-safe.
class Admission {
 public:
  struct Limits {
    std::int64_t queued_jobs = 100'000;
    std::int64_t job_memory_bytes = 0;            ///< that a job may be predicted to need; 0: what the machine has
    std::int64_t free_disk_bytes = 0;             ///< that are to be left in the data folder
    std::chrono::duration<double> job_time{0.0};  ///< of the clock that a job's workers may take; 0: no limit
    OwnerLimits owner;
  };

  /// What is asked how much there is already; all of it outlives this object.
  struct Parts {
    const store::DataFolder& folder;
    store::JournalReader& reader;
    Scheduler& scheduler;
  };

  /// Jobs that were admitted and do not stand in the queue yet. Until this goes away they count as waiting, so that
  /// calls at the same time do not share what is left of a limit.
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

  /// From now on no job is taken.
  void drain() { draining_ = true; }

  /// Checks the seconds that a job asks for. Throws InvalidField.
  void check_time_limit(double seconds, const std::string& field) const;

  /// Checks the priority that jobs ask for against that of an owner. Throws InvalidField.
  void check_priority(int priority, const std::string& field) const { quotas_.check_priority(priority, field); }

  /// Memory of a job of which it is known that it is at most `most_bytes`: `predict` is asked only where that could be
  /// too much.
  [[nodiscard]] std::int64_t memory_of_job(std::int64_t most_bytes, const std::function<std::int64_t()>& predict) const;

  /// Whether so many more jobs of the owner, of which the largest needs so much memory, can be taken. Throws
  /// ServiceError: unavailable while draining, exhausted beyond a limit or a quota, storage_full.
  [[nodiscard]] Place admit(const std::string& owner, std::size_t count, std::int64_t memory_bytes);

  /// Why the disk has too little room for jobs, a sentence; nothing where it has room. Throws ServiceError.
  [[nodiscard]] std::optional<std::string> low_disk() const;

 private:
  Parts parts_;
  Limits limits_;
  OwnerQuotas quotas_;
  std::atomic<bool> draining_ = false;
  Mutex mutex_;
  std::map<std::string, std::size_t> admitted_ CELLCRUSH_GUARDED_BY(mutex_);  ///< jobs of places by owner
};

}  // namespace cellcrush::jobs
